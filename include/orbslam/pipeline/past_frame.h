// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/map/map.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// That a map point was seen.
struct Sighting {
  MapPointId point;
  Eigen::Vector3f pixel;  // (u, v, u_right), undistorted px; u_right < 0: without depth
  int level = 0;          // of the pyramid
};

/// A frame that has been tracked: relative to a keyframe, so that its pose benefits from what the map learns
/// later, and by what it saw. Without its sightings it is as it was found.
struct PastFrame {
  FrameId id;
  double timestamp_s = 0;
  KeyFrameId reference;
  Rigid3d camera_from_reference;
  Matrix6d pose_information = Matrix6d::Zero();  // UncertainPose's
  std::vector<Sighting> sightings;
};

std::vector<Sighting> SightingsOf(const Frame& frame);

/// Looks for its pose once more, over the same sightings of a map that knows better by now: wrong points, and
/// those on somebody who has set off since, are gone, the others have been adjusted. Sightings of
/// points that are gone are forgotten. False: it is a keyframe, whose pose is the map's, or most of its
/// points are gone; then its pose stays.
bool FindPoseAgain(const Map& map, const Sensor& sensor, PastFrame* frame);

}  // namespace orbslam
