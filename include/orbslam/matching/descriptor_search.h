// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "orbslam/features/frame_features.h"
#include "orbslam/matching/projection_search.h"

namespace orbslam {

struct DescriptorSearchOptions {
  int max_distance = kStrictMaxDistance;
  double max_ratio = 0.7;  // best / second best distance (Lowe's test)
  bool check_orientation = true;
};

/// Near enough, and clearly nearer than the second.
bool IsDistinct(const NearestTwo& nearest, const DescriptorSearchOptions& options);

/// Matches keypoints of two frames by appearance alone, each to each: for every keypoint of `from` listed in
/// from_indices the keypoint of `to`, or -1. A keypoint of `to` is matched at most once, to the nearest.
/// to_indices: which keypoints of `to` take part.
std::vector<int> SearchByDescriptor(const FrameFeatures& from, std::span<const int> from_indices,
                                    const FrameFeatures& to, std::span<const int> to_indices,
                                    const DescriptorSearchOptions& options);

}  // namespace orbslam
