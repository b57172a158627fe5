// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "script_cast.h"

namespace orbslam {
namespace {

using Eigen::Vector2d;

constexpr double kEdgeM = 0.06;  // people stay this far inside the free floor

Vector2d Inside(const Vector2d& place) {
  constexpr double kX = Script::kFreeX - kEdgeM, kY = Script::kFreeY - kEdgeM;
  return {std::clamp(place.x(), -kX, kX), std::clamp(place.y(), -kY, kY)};
}

}  // namespace

std::vector<SceneObject> ScriptCast::ObjectsAt(double time_s) const {
  std::vector<SceneObject> objects;
  for (const auto& actor : actors) {
    const std::vector<SceneObject> parts = actor->ObjectsAt(time_s);
    objects.insert(objects.end(), parts.begin(), parts.end());
  }
  for (const Thing& thing : things)
    thing.prop.AppendTo(thing.world_from_thing(time_s), thing.label, &objects);
  return objects;
}

Stage::Stage(const CameraView& view) : camera_(view.position.head<2>()), origin_(camera_) {
  heading_ = Towards(camera_, view.target.head<2>());
  // Walk ahead until the free floor ends.
  constexpr double kStepM = 0.01;
  double depth = 0;
  const auto is_free = [&](double ahead) {
    const Vector2d place = camera_ + ahead * Ahead(heading_);
    return (Inside(place) - place).norm() < 1e-9;
  };
  while (depth < kDepthM && is_free(depth + kStepM)) depth += kStepM;
  origin_ -= std::max(0.0, kDepthM - depth - kStepM) * Ahead(heading_);
}

Vector2d Stage::At(double right, double ahead) const {
  return Inside(origin_ + ahead * Ahead(heading_) - right * LeftOf(heading_));
}

double Stage::Towards(const Vector2d& from, const Vector2d& to) const {
  const Vector2d way = to - from;
  return std::atan2(way.y(), way.x());
}

Director::Director(const Stage& stage, const Figure& figure, double side, double right, double ahead,
                   double speed, Rng* rng)
    : stage_(stage),
      side_(side),
      speed_(speed),
      rng_(rng),
      first_{stage.At(side * right, ahead), 0},
      plan_({}, figure.size().half_stance, figure.size().foot) {
  first_.heading = stage.ToCamera(first_.position);
  plan_ = GaitPlan(first_, figure.size().half_stance, figure.size().foot);
}

Director& Director::Wait(double least_s, double most_s) {
  plan_.Stand(rng_->Uniform(least_s, most_s));
  return *this;
}

Director& Director::Go(double right, double ahead) {
  plan_.WalkTo(stage_.At(side_ * right, ahead), speed_);
  return *this;
}

Director& Director::Face() {
  plan_.TurnTo(stage_.ToCamera(plan_.end().position));
  return *this;
}

Director& Director::Back() {
  plan_.WalkTo(first_.position, speed_);
  plan_.TurnTo(first_.heading);
  return *this;
}

GaitPlan Director::Looped() {
  Back();
  plan_.Loop();
  return plan_;
}

}  // namespace orbslam
