// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <vector>

#include "orbslam/map/map.h"
#include "orbslam/pipeline/past_frame.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Looks for the pose of every frame once more some time later (FindPoseAgain). Who needs a pose at once has
/// had it; trajectories are made of the later one. Where most matches are gone by then, the first pose
/// stands.
class PoseReviser {
 public:
  PoseReviser(const Map& map, const Sensor& sensor) : map_(map), sensor_(sensor) {}

  /// frame: later than those before.
  void Keep(PastFrame frame) { kept_.push_back(std::move(frame)); }

  /// What frames after since_s saw of these points no longer counts.
  void Retract(std::vector<MapPointId> points, double since_s);

  /// The frames taken until then are done with and forgotten; those whose pose was found anew.
  std::vector<PastFrame> ReviseUntil(double timestamp_s);

 private:
  const Map& map_;
  const Sensor& sensor_;
  std::deque<PastFrame> kept_;  // oldest first
};

}  // namespace orbslam
