// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "orbslam/synthetic/figure.h"
#include "orbslam/synthetic/gait.h"

namespace orbslam {

/// A time during which both hands are at a thing, with half a second before and after to reach out and let
/// go. wrists: world, metres, left first; lean: of the torso, forwards, radians.
struct Grip {
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();
  std::function<std::array<Eigen::Vector3d, 2>(double time_s)> wrists;
  double lean = 0;
};

/// Someone with a plan: the gait carries the body, arms swing against the legs, and who stands or sits is
/// never quite still (below 2 cm/s, unless he gestures). A pure function of time.
class Actor {
 public:
  Actor(Figure figure, GaitPlan plan, uint8_t label, uint64_t seed);

  /// Hands, head and torso talk: 0 not at all, 1 as people do who sit and discuss.
  void Gesture(double strength) { gesture_ = strength; }
  void Hold(Grip grip) { grips_.push_back(std::move(grip)); }

  const Figure& figure() const { return figure_; }
  const GaitPlan& plan() const { return plan_; }
  uint8_t label() const { return label_; }

  BodyPose PoseAt(double time_s) const;
  /// The torso's frame, which no grip's hands change: what carried things hang on.
  Rigid3d TorsoAt(double time_s) const;
  std::vector<SceneObject> ObjectsAt(double time_s) const {
    return figure_.ObjectsAt(PoseAt(time_s), label_);
  }

 private:
  UpperBody UpperBodyAt(double time_s, const GaitState& gait) const;
  void AddIdling(double time_s, UpperBody* upper) const;
  void AddGestures(double time_s, UpperBody* upper) const;

  Figure figure_;
  GaitPlan plan_;
  uint8_t label_;
  double phase_;  // seconds that his restlessness runs ahead of the clock
  double gesture_ = 0;
  std::vector<Grip> grips_;
};

}  // namespace orbslam
