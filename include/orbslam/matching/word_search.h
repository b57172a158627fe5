// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/features/frame_features.h"
#include "orbslam/matching/descriptor_search.h"
#include "orbslam/vocabulary/bow.h"

namespace orbslam {

/// As SearchByDescriptor over all keypoints, but compares only those that share a node of the vocabulary
/// tree: several hundred times fewer. takes_part_*: one a keypoint, or empty: all. Returns, for every
/// keypoint of `from`, the keypoint of `to` or -1.
std::vector<int> SearchByWords(const FrameFeatures& from, const DirectIndex& from_index,
                               const std::vector<char>& takes_part_from, const FrameFeatures& to,
                               const DirectIndex& to_index, const std::vector<char>& takes_part_to,
                               const DescriptorSearchOptions& options);

}  // namespace orbslam
