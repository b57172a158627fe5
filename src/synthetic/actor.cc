// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/actor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double Wave(double time_s, double period_s) { return std::sin(kTurn * time_s / period_s); }

/// Comes and goes: 0 for half of the period, with a smooth hump between.
double Burst(double time_s, double period_s) {
  const double wave = std::max(0.0, Wave(time_s, period_s));
  return wave * wave;
}

/// Weight of a grip: 1 between its times, smooth over half a second outside.
double Weight(const Grip& grip, double time_s) {
  constexpr double kReachS = 0.5;
  return std::min(SmoothStep((time_s - grip.from_s) / kReachS + 1),
                  SmoothStep((grip.until_s - time_s) / kReachS + 1));
}

/// How far a foot is ahead of the body, metres.
double FootAhead(const GaitState& gait, int foot) {
  return (gait.feet[foot].ankle.head<2>() - gait.body.position).dot(Ahead(gait.body.heading));
}

UpperBody Swinging(const GaitState& gait) {
  constexpr double kArmPerM = 0.75, kPelvisPerM = 0.16, kTorsoPerM = 0.14;  // radians a metre of stride
  const double standing = 1 - gait.seated, stride = standing * (FootAhead(gait, 0) - FootAhead(gait, 1));
  UpperBody upper;
  upper.pelvis_yaw = -kPelvisPerM * stride;
  upper.torso_yaw = kTorsoPerM * stride;
  upper.head_yaw = -upper.torso_yaw;
  const double rising = 4 * gait.seated * standing;  // half-way between chair and feet one bends
  upper.torso_pitch = 0.03 + 0.05 * std::abs(stride) + 0.55 * rising;
  upper.torso_roll = 0.8 * gait.sway_m;
  for (int side = 0; side < 2; ++side) {
    ArmControl& arm = upper.arms[side];
    const double forward = (side == 0 ? -1 : 1) * kArmPerM * stride;
    arm.flexion = 0.05 + forward + 0.42 * gait.seated;
    arm.elbow = 0.28 + 0.5 * std::max(0.0, forward) + 0.75 * gait.seated;
    arm.turn = 0.15 + 0.45 * gait.seated;
  }
  return upper;
}

}  // namespace

Actor::Actor(Figure figure, GaitPlan plan, uint8_t label, uint64_t seed)
    : figure_(std::move(figure)), plan_(std::move(plan)), label_(label) {
  constexpr uint64_t kPhasePurpose = 0x70686173;
  phase_ = Rng(seed, label, kPhasePurpose).Uniform(0, 60);
}

void Actor::AddIdling(double time_s, UpperBody* upper) const {
  const double t = time_s + phase_;
  upper->torso_pitch += 0.0035 * Wave(t, 4.3);
  upper->torso_roll += 0.0035 * Wave(t, 5.9);
  upper->torso_yaw += 0.006 * Wave(t, 7.1);
  upper->head_yaw += 0.05 * Wave(t, 8.3);
  upper->head_pitch += 0.03 * Wave(t, 6.7);
  for (int side = 0; side < 2; ++side) upper->arms[side].flexion += 0.006 * Wave(t + side, 5.1);
}

void Actor::AddGestures(double time_s, UpperBody* upper) const {
  const double t = time_s + phase_;
  upper->head_yaw += gesture_ * 0.55 * std::tanh(3 * Wave(t, 6.1));
  upper->head_pitch += gesture_ * 0.12 * Wave(t, 1.9) * Burst(t, 5.3);
  upper->torso_pitch += gesture_ * 0.09 * Wave(t, 5.7);
  upper->torso_yaw += gesture_ * 0.16 * Wave(t, 7.7);
  for (int side = 0; side < 2; ++side) {
    ArmControl& arm = upper->arms[side];
    const double talking = gesture_ * Burst(t + 3.1 * side, 6.9 + 1.3 * side);
    arm.flexion += talking * (0.35 + 0.15 * Wave(t, 1.3));
    arm.elbow += talking * (0.55 + 0.30 * Wave(t + 0.4, 1.1));
    arm.turn += talking * 0.4 * Wave(t, 1.7);
    arm.abduction += talking * 0.15;
  }
}

UpperBody Actor::UpperBodyAt(double time_s, const GaitState& gait) const {
  UpperBody upper = Swinging(gait);
  AddIdling(time_s, &upper);
  AddGestures(time_s, &upper);
  for (const Grip& grip : grips_) upper.torso_pitch += grip.lean * Weight(grip, time_s);
  return upper;
}

Rigid3d Actor::TorsoAt(double time_s) const {
  const GaitState gait = plan_.At(time_s);
  return SolveBodyPose(figure_.size(), gait, UpperBodyAt(time_s, gait))[kTorso];
}

BodyPose Actor::PoseAt(double time_s) const {
  const GaitState gait = plan_.At(time_s);
  UpperBody upper = UpperBodyAt(time_s, gait);
  for (const Grip& grip : grips_) {
    const double weight = Weight(grip, time_s);
    if (weight <= 0 || !grip.wrists) continue;
    const auto wrists = grip.wrists(time_s);
    for (int side = 0; side < 2; ++side) {
      upper.arms[side].wrist = wrists[side];
      upper.arms[side].wrist_weight = weight;
    }
  }
  return SolveBodyPose(figure_.size(), gait, upper);
}

}  // namespace orbslam
