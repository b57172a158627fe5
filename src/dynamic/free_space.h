// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "orbslam/dynamic/dynamic_detector_options.h"
#include "reference_view.h"

namespace orbslam {

/// What the references saw of each cell of the present frame.
struct Sightings {
  cv::Mat1b num_free;    // half votes of the references that saw through it
  cv::Mat1b num_static;  // references that saw it there, not moving: one for each
};

/// Under which gate, and of which references.
struct SightingRules {
  FreeSpaceOptions options;
  int min_age_frames = 0;
};

/// Under each of the rules; what costs most is done once for all.
std::vector<Sightings> CountSightings(const GridCamera& camera, const cv::Mat1f& depth_m,
                                      std::span<const ReferenceView* const> references,
                                      std::span<const SightingRules> rules);

/// What they say of it.
struct FreeSpaceVotes : Sightings {
  cv::Mat1b suspicious;        // non-zero: stands in space that was free
  cv::Mat1b confirmed_static;  // non-zero: was there before, and nobody saw through it
};
FreeSpaceVotes VoteOnFreeSpace(Sightings sightings, const FreeSpaceOptions& options);
FreeSpaceVotes VoteOnFreeSpace(const GridCamera& camera, const cv::Mat1f& depth_m,
                               std::span<const ReferenceView* const> references,
                               const FreeSpaceOptions& options);

/// Takes back what says that these cells (non-zero) are static; what says that they are not stays.
void WithdrawStatic(const cv::Mat1b& cells, FreeSpaceVotes* votes);

}  // namespace orbslam
