// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "orbslam/features/frame_features.h"

namespace orbslam {

/// Hamming distances of 256-bit ORB descriptors below which two are taken for the same point (Mur-Artal
/// 2015).
inline constexpr int kStrictMaxDistance = 50;
inline constexpr int kLooseMaxDistance = 100;

/// "A point with this descriptor should be about here."
struct ProjectionQuery {
  Descriptor descriptor;
  float u = 0, v = 0;  // undistorted px
  float right_u = -1;  // where the virtual right camera should see it, px; < 0: not compared
  float radius_px = 0;
  int min_level = 0, max_level = 0;
  float angle_deg = -1;  // of the keypoint it was last seen as; < 0: takes no part in the orientation check
};

struct ProjectionSearchOptions {
  int max_distance = kLooseMaxDistance;
  double max_ratio = 1.0;  // best / second best distance, if both are of one level (Lowe's test); 1: off
  bool check_orientation = false;  // keep only matches that agree on how the camera rolled
};

/// For each query the index of its keypoint, or -1. A keypoint goes to the query that is nearest to it;
/// keypoints whose is_taken (one a keypoint, or empty) is set go to none.
std::vector<int> SearchByProjection(std::span<const ProjectionQuery> queries, const FrameFeatures& features,
                                    std::span<const char> is_taken, const ProjectionSearchOptions& options);

}  // namespace orbslam
