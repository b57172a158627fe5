// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orbslam/loop/loop_options.h"
#include "orbslam/map/map.h"
#include "orbslam/pipeline/place_index.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// A keypoint of the current keyframe that shows a point of the old place.
struct LoopPoint {
  int keypoint = -1;
  MapPointId point;
};

/// A loop that geometry confirms.
struct Loop {
  KeyFrameId current, old;
  Rigid3d current_from_old;       // as seen now, against the drift between them
  std::vector<LoopPoint> points;  // ascending in keypoint
};

/// Do the two keyframes show the same place, and how does one see it from the other? Matches by words, RANSAC
/// over rigid motions, a guided second look, refinement, and confirmation by the old place's neighbours.
/// (ORB-SLAM, section VII-B; scale is fixed, as depth observes it.)
std::optional<Loop> VerifyLoop(const LoopOptions& options, const Sensor& sensor, const PlaceIndex& places,
                               const Map& map, KeyFrameId current, KeyFrameId old);

}  // namespace orbslam
