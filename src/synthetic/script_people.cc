// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <array>
#include <utility>

#include "script_cast.h"

namespace orbslam {
namespace {

constexpr uint64_t kScriptPurpose = 0x73637274;
constexpr uint8_t kFirst = Script::kFirstPersonLabel, kSecond = kFirst + 1;

double Side(Rng* rng) { return rng->Below(2) == 0 ? 1 : -1; }

std::shared_ptr<const Actor> Play(Figure figure, GaitPlan plan, uint8_t label, uint64_t seed) {
  return std::make_shared<const Actor>(std::move(figure), std::move(plan), label, seed);
}

/// One walks to and fro a metre before the camera and comes close twice a round; the other, half a metre
/// behind him, walks, leaves the picture, sits down on a chair and stands up.
void AddWalking(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  const double side = Side(rng);
  const Figure near(seed, 0), far(seed, 1);
  Director one(stage, near, side, -0.75, 1.02, rng->Uniform(0.40, 0.60), rng);
  one.Wait(0.1, 0.4).Go(0.05, 1.02).Face().Go(0.06, 0.85).Wait(1.0, 2.0);
  one.Go(1.0, 0.95).Go(1.75, 0.95).Wait(0.6, 1.2).Go(-0.1, 1.05).Face().Wait(1.0, 2.0);
  one.Go(-0.08, 0.85).Wait(1.0, 1.8).Go(-0.75, 1.02).Face();
  cast->actors.push_back(Play(near, one.Looped(), kFirst, seed));

  Director two(stage, far, side, 0.80, 1.50, rng->Uniform(0.35, 0.55), rng);
  two.Wait(0.2, 0.5).Go(-0.35, 1.50).Wait(1.0, 3.0).Go(-1.75, 1.50).Wait(0.4, 1.0).Go(0.25, 1.52).Face();
  two.Wait(1.0, 2.0).Back();
  const Placement chair_at = two.plan().end();
  two.plan().SitDown();
  two.Wait(0.8, 1.6);
  two.plan().StandUp();
  cast->actors.push_back(Play(far, two.Looped(), kSecond, seed));
  cast->things.push_back(ChairBehind(far, chair_at, seed, Script::kFirstThingLabel));
}

void AddSitting(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  for (int i = 0; i < 2; ++i) {
    const double right = (i == 0 ? -1 : 1) * rng->Uniform(0.32, 0.42);
    const Figure figure(seed, i);
    Director director(stage, figure, 1, right, rng->Uniform(0.95, 1.1), 0.5, rng);
    GaitPlan plan = director.plan();
    const double inwards = (i == 0 ? 1 : -1) * rng->Uniform(0.2, 0.5);
    Placement body = plan.end();
    body.heading += inwards;
    plan = GaitPlan(body, figure.size().half_stance, figure.size().foot);
    plan.SitDown();
    plan.StartAt(plan.duration_s());
    Actor actor(figure, plan, static_cast<uint8_t>(kFirst + i), seed);
    actor.Gesture(rng->Uniform(0.8, 1.0));
    cast->actors.push_back(std::make_shared<const Actor>(std::move(actor)));
    cast->things.push_back(
        ChairBehind(figure, body, seed + i, static_cast<uint8_t>(Script::kFirstThingLabel + i)));
  }
}

void AddClose(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  constexpr double kTallM = 1.90;  // so that the shoulders reach the picture's upper edge
  const Figure figure(seed, 0, kTallM);
  Director director(stage, figure, Side(rng), 0.5, 1.5, rng->Uniform(0.4, 0.55), rng);
  director.Wait(0.3, 0.8).Go(0, 1.1).Face().Go(-0.17, 0.5).Wait(2.0, 3.0).Go(-0.8, 1.1).Go(-1.75, 1.2);
  director.Wait(0.5, 1.0).Go(-0.2, 1.5);
  cast->actors.push_back(Play(figure, director.Looped(), kFirst, seed));
}

void AddCrossing(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  for (int i = 0; i < 2; ++i) {
    const Figure figure(seed, i);
    const double lane = i == 0 ? 1.0 : 1.5, side = i == 0 ? 1 : -1;
    Director director(stage, figure, side, -0.85, lane, rng->Uniform(0.4, 0.6), rng);
    director.Wait(0.1, 0.4).Go(1.25, lane).Wait(0.3, 0.8);
    cast->actors.push_back(Play(figure, director.Looped(), static_cast<uint8_t>(kFirst + i), seed));
  }
}

/// One walks before all others, another behind him, and two keep to the halves of the lane along the desk.
void AddCrowd(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  struct Beat {
    double side, from, to, lane;
  };
  const double side = Side(rng);
  const std::array<Beat, 4> beats = {
      {{1, -1.1, 0.7, 0.84}, {-1, -1.2, 0.8, 1.29}, {1, 0.3, 1.6, 1.74}, {-1, 0.3, 1.6, 1.74}}};
  for (size_t i = 0; i < beats.size(); ++i) {
    const Beat& beat = beats[i];
    const Figure figure(seed, static_cast<int>(i));
    Director director(stage, figure, side * beat.side, beat.from, beat.lane, rng->Uniform(0.4, 0.6), rng);
    director.Wait(0.1, 1.0).Go(rng->Uniform(0.3, 0.6), beat.lane);
    if (i % 2 == 0) director.Face();
    director.Wait(1.0, 4.0).Go(beat.to, beat.lane).Wait(0.3, 1.5);
    cast->actors.push_back(Play(figure, director.Looped(), static_cast<uint8_t>(kFirst + i), seed));
  }
}

void AddWaiting(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  const Figure figure(seed, 0);
  Director director(stage, figure, Side(rng), 0.1, 1.1, rng->Uniform(0.4, 0.6), rng);
  director.Wait(5.0, 5.0).Go(1.75, 1.1).Wait(0.5, 1.0).Go(-0.7, 1.1).Wait(0.5, 1.0);
  cast->actors.push_back(Play(figure, director.Looped(), kFirst, seed));
}

/// Both stand outside the picture of a camera that looks at its target: one 50 degrees aside, one behind.
void AddNewlySeen(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  const double side = Side(rng);
  const Figure first(seed, 0), second(seed, 1);
  Director one(stage, first, side, 1.25, 1.05, rng->Uniform(0.4, 0.6), rng);
  one.Wait(8.0, 8.0).Go(-0.6, 1.05).Wait(1.0, 2.0);
  cast->actors.push_back(Play(first, one.Looped(), kFirst, seed));
  Director two(stage, second, side, -1.4, -0.6, rng->Uniform(0.4, 0.6), rng);
  two.Wait(12.0, 12.0).Go(-1.4, 1.55).Wait(0.5, 1.0).Go(0.8, 1.55).Wait(0.5, 1.0).Go(-1.4, 1.55);
  cast->actors.push_back(Play(second, two.Looped(), kSecond, seed));
}

void AddMonitor(const Stage& stage, uint64_t seed, Rng* rng, ScriptCast* cast) {
  const Figure figure(seed, 0);
  Director director(stage, figure, Side(rng), -0.9, 1.70, rng->Uniform(0.35, 0.5), rng);
  director.Wait(0.3, 0.8)
      .Go(0.2, 1.70)
      .Wait(1.5, 2.5)
      .Go(1.1, 1.70)
      .Wait(0.5, 1.0)
      .Go(-0.3, 1.70)
      .Wait(1.5, 2.5);
  cast->actors.push_back(Play(figure, director.Looped(), kFirst, seed));
}

}  // namespace

ScriptCast::Thing ChairBehind(const Figure& figure, const Placement& body, uint64_t seed, uint8_t label) {
  Rigid3d chair;
  const Eigen::Vector2d place = body.position - (SeatedHipsBack(figure.size()) - 0.02) * Ahead(body.heading);
  chair.translation = {place.x(), place.y(), 0};
  chair.rotation = Eigen::AngleAxisd(body.heading, Eigen::Vector3d::UnitZ());
  return {MakeOfficeChair(seed), label, [chair](double) { return chair; }};
}

ScriptCast MakeCast(ScriptKind kind, uint64_t seed, const CameraView& view) {
  const Stage stage(view);
  Rng rng(seed, static_cast<uint64_t>(kind), kScriptPurpose);
  ScriptCast cast;
  switch (kind) {
    case ScriptKind::kStatic:
      break;
    case ScriptKind::kWalking:
      AddWalking(stage, seed, &rng, &cast);
      break;
    case ScriptKind::kSitting:
      AddSitting(stage, seed, &rng, &cast);
      break;
    case ScriptKind::kObjects:
      AddObjectsScript(stage, seed, &cast);
      break;
    case ScriptKind::kClose:
      AddClose(stage, seed, &rng, &cast);
      break;
    case ScriptKind::kStillThenAll:
      AddStillThenAllScript(stage, seed, &cast);
      break;
    case ScriptKind::kCover:
      AddCoverScript(stage, seed, &cast);
      break;
    case ScriptKind::kCrossing:
      AddCrossing(stage, seed, &rng, &cast);
      break;
    case ScriptKind::kCrowd:
      AddCrowd(stage, seed, &rng, &cast);
      break;
    case ScriptKind::kWaiting:
      AddWaiting(stage, seed, &rng, &cast);
      break;
    case ScriptKind::kNewlySeen:
      AddNewlySeen(stage, seed, &rng, &cast);
      break;
    case ScriptKind::kPutDown:
      AddPutDownScript(stage, seed, &cast);
      break;
    case ScriptKind::kTakenAway:
      AddTakenAwayScript(stage, seed, &cast);
      break;
    case ScriptKind::kMonitor:
      AddMonitor(stage, seed, &rng, &cast);
      break;
  }
  return cast;
}

}  // namespace orbslam
