// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/map/map.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/tracking/tracking_options.h"

namespace orbslam {

/// Finds a first pose of a new frame from what is just behind it. Both ways fill `frame` (pose, points) and
/// return the number of inliers; fewer than options.min_inliers means that the way failed.
class FrameTracker {
 public:
  FrameTracker(const Map& map, const Sensor& sensor, const TrackingOptions& options)
      : map_(map), sensor_(sensor), options_(options) {}

  /// Looks for the last frame's points where frame->camera_from_world, the prediction, puts them.
  int TrackLastFrame(const Frame& last, Frame* frame) const;

  /// Matches with a keyframe by appearance, when there is no good prediction; needs none.
  int TrackKeyFrame(KeyFrameId keyframe, Frame* frame) const;

 private:
  const Map& map_;
  const Sensor& sensor_;
  const TrackingOptions& options_;
};

}  // namespace orbslam
