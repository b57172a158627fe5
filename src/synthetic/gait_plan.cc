// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "orbslam/synthetic/gait.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn = 2.0 * std::numbers::pi, kDegree = kTurn / 360.0;
constexpr double kDoubleSupport = 0.2;  // share of a step's time with both feet down (Winter 1991)
constexpr double kHeelRise = 0.35;      // share of the time in the air that the heel rises before it
constexpr double kFlatten = 0.25;       // likewise, that the sole takes to come down after it
constexpr double kTurnStepS = 0.42, kTurnStepRad = 55 * kDegree;
constexpr double kSitS = 1.8;

double WrappedAngle(double angle) { return std::remainder(angle, kTurn); }

Placement Blend(const Placement& a, const Placement& b, double weight_b) {
  return {a.position + weight_b * (b.position - a.position),
          a.heading + weight_b * WrappedAngle(b.heading - a.heading)};
}

/// Slow walkers take shorter steps (Grieve and Gear 1966: step length grows about with the root of speed).
double StepLength(double speed) { return 0.56 * std::sqrt(std::clamp(speed, 0.1, 2.0) / 0.9); }

/// Steps gone after `steps` step times, of `total`: half a step while speeding up, half while slowing down.
double StepsGone(double steps, double total) {
  const auto ramp = [](double x) { return x * x * x * (1 - 0.5 * x); };  // the integral of SmoothStep
  if (steps < 1) return ramp(steps);
  return steps <= total - 1 ? steps - 0.5 : total - 1 - ramp(total - steps);
}

/// The foot's pitch when it leaves the floor and when it comes down: long strides roll from heel to toe.
struct Roll {
  double off, strike;
};

Roll RollOf(const Placement& from, const Placement& to) {
  const Vector2d stride = to.position - from.position;
  const double ahead = std::max(0.0, stride.dot(Ahead(to.heading)));
  const double share = std::min(1.0, ahead / 1.1);
  return {-(12 + 46 * share) * kDegree, 20 * share * kDegree};
}

Vector3d OnFloor(const Vector2d& xy, double z) { return {xy.x(), xy.y(), z}; }

/// The share of the way that the foot's pitch has gone from the toe's off to the heel's strike.
double PitchGone(double fraction) {
  constexpr double kToeOff = 0.6;
  const auto pitch = [](double phase) {
    const LegAngles a = WalkingAngles(phase);
    return a.hip - a.knee + a.ankle;
  };
  const double off = pitch(kToeOff), strike = pitch(1.0);
  return (pitch(kToeOff + (1 - kToeOff) * fraction) - off) / (strike - off);
}

/// A foot that rests on heel or ball at its print, pitched about that point.
FootState Resting(const FootShape& shape, const Placement& print, double pitch) {
  FootState foot;
  foot.heading = print.heading;
  foot.pitch = pitch;
  const double along = pitch > 0 ? -shape.heel : shape.ball;
  const Vector3d contact = OnFloor(print.position + along * Ahead(print.heading), 0);
  foot.ankle = contact - SolePoint(shape, foot, along);
  return foot;
}

/// The toes stay in line with the foot as far as the floor lets them.
void LayToes(const FootShape& shape, FootState* foot) {
  const double ball_height = std::max(0.0, SolePoint(shape, *foot, shape.ball).z());
  const double droop = std::asin(std::min(1.0, ball_height / (shape.toe - shape.ball)));
  foot->toe_pitch = std::max(foot->pitch, -droop);
}

}  // namespace

GaitPlan::GaitPlan(const Placement& start, double half_stance_m, const FootShape& shape)
    : half_stance_m_(half_stance_m), shape_(shape), start_(start), end_(start) {
  for (int foot = 0; foot < 2; ++foot) prints_[foot] = Print(foot, start);
}

Placement GaitPlan::Print(int foot, const Placement& body) const {
  const double side = foot == 0 ? half_stance_m_ : -half_stance_m_;
  return {body.position + side * LeftOf(body.heading), body.heading};
}

void GaitPlan::AddStep(int foot, double start_s, double duration_s, const Placement& print) {
  steps_[foot].push_back({start_s + kDoubleSupport * duration_s, start_s + duration_s, prints_[foot], print});
  prints_[foot] = print;
}

void GaitPlan::AddPiece(Kind kind, double duration_s, const Placement& to, int num_steps, double seated) {
  ORBSLAM_CHECK(!loops_);
  pieces_.push_back({kind, end_s_, end_s_ + duration_s, end_, to, num_steps, seated_, seated});
  end_s_ += duration_s;
  end_ = to;
  seated_ = seated;
}

void GaitPlan::Stand(double duration_s) { AddPiece(Kind::kStand, duration_s, end_, 0, seated_); }
void GaitPlan::SitDown() { AddPiece(Kind::kSit, kSitS, end_, 0, 1); }
void GaitPlan::StandUp() { AddPiece(Kind::kSit, kSitS, end_, 0, 0); }

void GaitPlan::TurnTo(double heading) {
  const double angle = WrappedAngle(heading - end_.heading);
  if (std::abs(angle) < 1e-6) return;
  const int pairs = static_cast<int>(std::ceil(std::abs(angle) / kTurnStepRad));
  const int inner = angle > 0 ? 0 : 1;  // steps first, so that the feet do not cross
  for (int i = 0; i < 2 * pairs; ++i) {
    const Placement body{end_.position, end_.heading + angle * (i / 2 + 1) / pairs};
    const int foot = i % 2 == 0 ? inner : 1 - inner;
    AddStep(foot, end_s_ + i * kTurnStepS, kTurnStepS, Print(foot, body));
  }
  AddPiece(Kind::kTurn, 2 * pairs * kTurnStepS, {end_.position, end_.heading + angle}, 2 * pairs, seated_);
}

void GaitPlan::WalkTo(const Vector2d& target, double speed) {
  ORBSLAM_CHECK(speed > 0 && seated_ == 0);
  const Vector2d way = target - end_.position;
  if (way.norm() < 1e-6) return;
  TurnTo(std::atan2(way.y(), way.x()));
  const int strides = std::max(1, static_cast<int>(std::lround(way.norm() / StepLength(speed))));
  const double step_s = way.norm() / strides / speed;
  for (int i = 0; i <= strides; ++i) {
    const double share = static_cast<double>(std::min(i + 1, strides)) / strides;
    const Placement body{end_.position + share * way, end_.heading};
    AddStep(i % 2, end_s_ + i * step_s, step_s, Print(i % 2, body));
  }
  AddPiece(Kind::kWalk, (strides + 1) * step_s, {target, end_.heading}, strides + 1, 0);
}

void GaitPlan::Loop() {
  ORBSLAM_CHECK((end_.position - start_.position).norm() < 1e-6 && seated_ == 0 && end_s_ > 0);
  ORBSLAM_CHECK(std::abs(WrappedAngle(end_.heading - start_.heading)) < 1e-6);
  loops_ = true;
}

FootState GaitPlan::Swing(const Step& step, double fraction) const {
  const Roll roll = RollOf(step.from, step.to);
  const FootState off = Resting(shape_, step.from, roll.off);
  const FootState strike = Resting(shape_, step.to, std::max(roll.strike, 1e-9));
  const double gone = SmoothStep(fraction);
  FootState foot;
  foot.planted = false;
  foot.heading = Blend(step.from, step.to, gone).heading;
  foot.pitch = roll.off + PitchGone(fraction) * (roll.strike - roll.off);
  foot.ankle = off.ankle + gone * (strike.ankle - off.ankle);
  constexpr double kLiftM = 0.03, kClearanceM = 0.012;
  const double up = std::sin(std::numbers::pi * fraction);
  foot.ankle.z() += kLiftM * up;
  const double lowest =
      std::min(SolePoint(shape_, foot, -shape_.heel).z(), SolePoint(shape_, foot, shape_.ball).z());
  foot.ankle.z() += std::max(0.0, kClearanceM * up - lowest);
  return foot;
}

FootState GaitPlan::FootAt(int foot, double time_s) const {
  const auto& steps = steps_[foot];
  // The first step that has not ended.
  const auto next = std::partition_point(steps.begin(), steps.end(),
                                         [time_s](const Step& step) { return step.end_s <= time_s; });
  double pitch = 0;
  Placement print = prints_[foot];
  if (next != steps.end()) {
    const double air_s = next->end_s - next->start_s;
    const double fraction = (time_s - next->start_s) / air_s;
    if (fraction > 0) {
      FootState state = Swing(*next, fraction);
      LayToes(shape_, &state);
      return state;
    }
    print = next->from;
    pitch += RollOf(next->from, next->to).off * SmoothStep(1 + fraction / kHeelRise);
  }
  if (next != steps.begin()) {
    const Step& last = *std::prev(next);
    const double since = (time_s - last.end_s) / (last.end_s - last.start_s);
    pitch += RollOf(last.from, last.to).strike * (1 - SmoothStep(since / kFlatten));
  }
  FootState state = Resting(shape_, print, pitch);
  LayToes(shape_, &state);
  return state;
}

GaitState GaitPlan::At(double time_s) const {
  time_s = std::max(0.0, time_s + first_s_);
  if (loops_) time_s -= end_s_ * std::floor(time_s / end_s_);
  GaitState state;
  state.body = start_;
  for (int foot = 0; foot < 2; ++foot) state.feet[foot] = FootAt(foot, time_s);
  if (pieces_.empty()) return state;
  const double inside_s = std::clamp(time_s, 0.0, end_s_);
  auto piece = std::partition_point(pieces_.begin(), pieces_.end(),
                                    [inside_s](const Piece& p) { return p.end_s <= inside_s; });
  if (piece == pieces_.end()) --piece;
  const double gone = (inside_s - piece->start_s) / (piece->end_s - piece->start_s);
  state.seated = piece->seated_from + (piece->seated_to - piece->seated_from) * SmoothStep(gone);
  state.body = Blend(piece->from, piece->to, SmoothStep(gone));
  if (piece->kind == Kind::kWalk) {
    const double steps = gone * piece->num_steps;
    state.body = Blend(piece->from, piece->to, StepsGone(steps, piece->num_steps) / (piece->num_steps - 1));
    constexpr double kSwayM = 0.022;
    state.sway_m = -kSwayM * std::sin(std::numbers::pi * steps);  // first over the right foot
  }
  return state;
}

}  // namespace orbslam
