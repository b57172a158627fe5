// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "script_cast.h"

namespace orbslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr uint64_t kThingsPurpose = 0x74686E67;
constexpr uint8_t kFirst = Script::kFirstPersonLabel, kSecond = kFirst + 1;
constexpr uint8_t kThing = Script::kFirstThingLabel;

Rigid3d OnFloor(const Placement& place, double z = 0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(place.heading, Vector3d::UnitZ())),
          {place.position.x(), place.position.y(), z}};
}

Rigid3d Shift(double x, double y, double z) { return {Eigen::Quaterniond::Identity(), {x, y, z}}; }

/// A thing held before the chest: upright, however the bearer bends, at an offset from his waist.
Rigid3d Held(const Actor& actor, double time_s, const Vector3d& offset) {
  const Rigid3d torso = actor.TorsoAt(time_s);
  const Vector3d ahead = torso.rotation * Vector3d::UnitX();
  const double heading = std::atan2(ahead.y(), ahead.x());
  const Rigid3d upright = OnFloor({torso.translation.head<2>(), heading}, torso.translation.z());
  return upright * Shift(offset.x(), offset.y(), offset.z());
}

/// Both hands at the sides of a thing, half a width from its middle.
std::array<Vector3d, 2> Sides(const Rigid3d& world_from_thing, const Vector3d& offset) {
  return {world_from_thing * offset, world_from_thing * Vector3d(offset.x(), -offset.y(), offset.z())};
}

const Vector3d kCartonOffset(0.36, 0, -0.02), kCartonGrip(-0.06, kCartonWidth / 2 + 0.02, 0.10);

std::shared_ptr<const Actor> Share(Actor actor) { return std::make_shared<const Actor>(std::move(actor)); }

/// Someone who holds something all the time, and that thing.
void AddBearer(const Actor& bearer, Prop prop, uint8_t label, const Vector3d& offset, const Vector3d& grip,
               ScriptCast* cast) {
  const auto held = [body = Share(bearer), offset](double time_s) { return Held(*body, time_s, offset); };
  Actor holding = bearer;
  holding.Hold({.wrists = [held, grip](double time_s) { return Sides(held(time_s), grip); }});
  cast->actors.push_back(Share(std::move(holding)));
  cast->things.push_back({std::move(prop), label, held});
}

const Vector3d kChairGrip(-0.27, 0.17, kChairBackHeight + 0.01);

/// The chair that someone pushes before him until `until_s`, and that stays there then.
void AddPusher(Actor pusher, double until_s, Prop chair, uint8_t label, ScriptCast* cast) {
  const auto chair_at = [plan = pusher.plan(), until_s](double time_s) {
    constexpr double kArmsM = 0.66;
    return OnFloor(plan.At(std::min(time_s, until_s)).body) * Shift(kArmsM, 0, 0);
  };
  const auto hands = [chair_at](double time_s) { return Sides(chair_at(time_s), kChairGrip); };
  pusher.Hold({.until_s = until_s, .wrists = hands, .lean = 0.18});
  cast->actors.push_back(Share(std::move(pusher)));
  cast->things.push_back({std::move(chair), label, chair_at});
}

void AddCabinet(const Stage& stage, double side, uint64_t seed, const GaitPlan& keeps_clear,
                ScriptCast* cast) {
  const Vector2d place = stage.At(side * 0.95, 1.86);
  const double heading = stage.heading() + std::numbers::pi;
  const Rigid3d cabinet = OnFloor({place, heading});
  cast->things.push_back({MakeCabinet(seed), 0, [cabinet](double) { return cabinet; }});
  // The hinge is on the outer side; the door opens while who passes there is on the other half.
  const Vector2d middle = stage.At(0, 1.35), outwards = -side * LeftOf(stage.heading());
  const auto door = [=](double time_s) {
    constexpr double kOpenRad = 1.3;
    const double away = 0.15 - (keeps_clear.At(time_s).body.position - middle).dot(outwards);
    const double angle = side * kOpenRad * SmoothStep(away / 0.6);
    return cabinet * Shift(kCabinetDepth / 2, side * kCabinetWidth / 2, 0) * OnFloor({{0, 0}, angle});
  };
  cast->things.push_back({MakeCabinetDoor(seed, side < 0), kThing + 2, door});
}

/// A table that has always been there, and someone who goes to it, puts a carton there or takes it away, and
/// leaves.
void AddHandling(const Stage& stage, uint64_t seed, bool takes, ScriptCast* cast) {
  constexpr double kHandS = 1.4, kLane = 1.35, kTableRight = 0.12, kReachM = 0.50;
  Rng rng(seed, takes ? 4 : 3, kThingsPurpose);
  const double side = rng.Below(2) == 0 ? 1 : -1;
  const Figure figure(seed, 0);
  Director director(stage, figure, side, 1.75, kLane, rng.Uniform(0.45, 0.6), &rng);
  director.Wait(0.2, 0.4).Go(kTableRight + kReachM, kLane);
  const double there_s = director.plan().duration_s();
  director.Wait(2 * kHandS, 2 * kHandS).Go(1.75, kLane);
  const double from_s = takes ? there_s + kHandS : there_s, until_s = from_s + kHandS;

  Actor actor(figure, director.plan(), kFirst, seed);
  actor.Hold({.from_s = there_s + 0.9 * kHandS, .until_s = there_s + 1.1 * kHandS, .lean = 0.4});
  const Vector2d table_at = stage.At(side * kTableRight, kLane);
  const Vector2d from = stage.At(side * 1.75, kLane);
  const Rigid3d table = OnFloor({table_at, stage.heading()});
  const Rigid3d resting = OnFloor({table_at, stage.Towards(from, table_at)}, kTableHeight);
  const auto carton = [body = Share(actor), resting, from_s, takes](double time_s) {
    const double gone = SmoothStep((time_s - from_s) / kHandS), in_hand = takes ? gone : 1 - gone;
    if (in_hand <= 0) return resting;
    const Rigid3d held = Held(*body, time_s, kCartonOffset);
    const Vector3d way = held.translation - resting.translation;
    return Rigid3d{resting.rotation.slerp(in_hand, held.rotation), resting.translation + in_hand * way};
  };
  Grip hands;
  (takes ? hands.from_s : hands.until_s) = takes ? from_s : until_s;
  hands.wrists = [carton](double time_s) { return Sides(carton(time_s), kCartonGrip); };
  actor.Hold(std::move(hands));
  cast->actors.push_back(Share(std::move(actor)));
  cast->things.push_back({MakeSideTable(seed), 0, [table](double) { return table; }});
  cast->things.push_back({MakeCarton(seed), kThing, carton});
}

}  // namespace

void AddObjectsScript(const Stage& stage, uint64_t seed, ScriptCast* cast) {
  Rng rng(seed, 0, kThingsPurpose);
  const double side = rng.Below(2) == 0 ? 1 : -1, speed = rng.Uniform(0.38, 0.52);
  const double pause_s = rng.Uniform(0.3, 0.9);
  // Both do the same at opposite ends, so that neither turns where the other stands.
  const auto pace = [&](const Figure& figure, double from, double lane) {
    GaitPlan plan({stage.At(from, lane), stage.Towards(stage.At(from, lane), stage.At(-from, lane))},
                  figure.size().half_stance, figure.size().foot);
    plan.Stand(pause_s);
    plan.WalkTo(stage.At(-from, lane), speed);
    plan.Stand(pause_s);
    plan.WalkTo(stage.At(from, lane), speed);
    plan.TurnTo(stage.Towards(stage.At(from, lane), stage.At(-from, lane)));
    plan.Loop();
    return plan;
  };
  const Figure carrier(seed, 0), pusher(seed, 1);
  AddBearer(Actor(carrier, pace(carrier, -side * 0.8, 0.90), kFirst, seed), MakeCarton(seed), kThing,
            kCartonOffset, kCartonGrip, cast);
  const GaitPlan pushing = pace(pusher, side * 0.8, 1.35);
  AddPusher(Actor(pusher, pushing, kSecond, seed), std::numeric_limits<double>::infinity(),
            MakeOfficeChair(seed), kThing + 1, cast);
  AddCabinet(stage, side, seed, pushing, cast);
}

void AddStillThenAllScript(const Stage& stage, uint64_t seed, ScriptCast* cast) {
  Rng rng(seed, 1, kThingsPurpose);
  constexpr double kStillS = 10.0;
  const double side = rng.Below(2) == 0 ? 1 : -1;
  const Figure walker(seed, 0), pusher(seed, 1);
  Director one(stage, walker, side, -0.25, 1.0, rng.Uniform(0.4, 0.55), &rng);
  one.Wait(kStillS, kStillS);
  for (int i = 0; i < 4; ++i) one.Go(-0.9, 1.0).Wait(0.4, 1.0).Go(0.7, 1.0).Wait(0.4, 1.0);
  cast->actors.push_back(Share(Actor(walker, one.plan(), kFirst, seed)));

  const double speed = rng.Uniform(0.4, 0.55), lane = 1.5;
  GaitPlan plan({stage.At(side * 0.75, lane), stage.Towards(stage.At(side, lane), stage.At(-side, lane))},
                pusher.size().half_stance, pusher.size().foot);
  plan.Stand(kStillS);
  plan.WalkTo(stage.At(-side * 0.45, lane), speed);
  const double pushed_s = plan.duration_s();
  plan.Stand(1.0);
  for (int i = 0; i < 4; ++i) {
    plan.WalkTo(stage.At(side * 1.0, lane), speed);
    plan.WalkTo(stage.At(-side * 0.35, lane), speed);
  }
  AddPusher(Actor(pusher, plan, kSecond, seed), pushed_s, MakeOfficeChair(seed), kThing, cast);
}

void AddCoverScript(const Stage& stage, uint64_t seed, ScriptCast* cast) {
  Rng rng(seed, 2, kThingsPurpose);
  const Figure figure(seed, 0);
  Director director(stage, figure, rng.Below(2) == 0 ? 1 : -1, 0.9, 1.5, rng.Uniform(0.4, 0.55), &rng);
  director.Wait(0.3, 0.8).Go(0.35, 1.5).Face().Go(0.35, 1.3).Wait(2.0, 3.0).Go(-1.75, 1.2).Wait(0.5, 1.0);
  director.Go(0.3, 1.5);
  const Vector3d offset(0.34, 0, 0.12), grip(-0.20, 0.30, -0.05);
  AddBearer(Actor(figure, director.Looped(), kFirst, seed), MakeBoard(seed), kThing, offset, grip, cast);
}

void AddPutDownScript(const Stage& stage, uint64_t seed, ScriptCast* cast) {
  AddHandling(stage, seed, false, cast);
}
void AddTakenAwayScript(const Stage& stage, uint64_t seed, ScriptCast* cast) {
  AddHandling(stage, seed, true, cast);
}

}  // namespace orbslam
