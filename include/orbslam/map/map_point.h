// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "orbslam/features/descriptor.h"
#include "orbslam/util/ids.h"

namespace orbslam {

/// "Keypoint `keypoint` of keyframe `keyframe` sees this point."
struct Observation {
  KeyFrameId keyframe;
  int keypoint = -1;

  friend bool operator==(const Observation&, const Observation&) = default;
};

/// A landmark. World frame, metres. (ORB-SLAM, Mur-Artal et al. 2015, section III-C.)
struct MapPoint {
  MapPointId id;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_world =
      Eigen::Vector3d::Zero();                    // mean unit vector from the observing cameras to the point
  Descriptor descriptor;                          // of the observation that is nearest to all others
  double min_distance_m = 0, max_distance_m = 0;  // within which its pyramid levels can see it
  KeyFrameId created_by;                          // never changes, though that keyframe may be culled
  std::vector<Observation> observations;          // ascending in keyframe
  int times_visible = 1;                          // frames whose view it was predicted to be in ...
  int times_found = 1;                            // ... and in which it was matched

  int NumObservations() const { return static_cast<int>(observations.size()); }
};

}  // namespace orbslam
