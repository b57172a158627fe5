// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "orbslam/map/map.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/messages.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Looks for the pose of every frame once more some time later, over the same matches. By then the map knows
/// better: wrong points and those on somebody who has set off are gone, the others have been adjusted. Who
/// needs a pose at once has had it; trajectories are made of the later one. Where most matches are gone by
/// then, the first pose stands.
class PoseReviser {
 public:
  PoseReviser(const Map& map, const Sensor& sensor) : map_(map), sensor_(sensor) {}

  /// frame: later than those before. camera_from_reference: the frame's pose relative to a keyframe.
  void Keep(Frame frame, KeyFrameId reference, const Rigid3d& camera_from_reference);

  /// The frames taken until then are done with and forgotten; those whose pose was found anew.
  std::vector<RevisedPose> ReviseUntil(double timestamp_s);

 private:
  struct Kept {
    Frame frame;
    KeyFrameId reference;
    Rigid3d camera_from_reference;
  };
  std::optional<RevisedPose> Revise(Kept kept) const;

  const Map& map_;
  const Sensor& sensor_;
  std::deque<Kept> kept_;  // oldest first
};

}  // namespace orbslam
