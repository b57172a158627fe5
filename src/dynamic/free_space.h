// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "reference_view.h"

namespace orbslam {

struct FreeSpaceOptions {
  float gate_sigma = 4.f;           // of the depth noise: one false vote in 16000 cells
  float margin_m = 0.01f;           // systematic depth error between two views at 0 m ...
  float margin_per_metre = 0.3f;    // ... and its growth, share a metre of depth
  float drift_m = 0.0004f;          // growth of the margin a frame of age: residual drift of the alignment
  float min_votes = 0.9f;           // free minus half of the static votes
  int min_suspicious_neighbors = 4; // of the 3 x 3 cells
};

/// What the references say of each cell of the present frame.
struct FreeSpaceVotes {
  cv::Mat1b num_free, num_static;    // references that saw through it; that saw it there, not moving
  cv::Mat1b suspicious;              // non-zero: stands in space that was free
  cv::Mat1b confirmed_static;        // non-zero: was there before, and nobody saw through it
};

FreeSpaceVotes VoteOnFreeSpace(const GridCamera& camera, const cv::Mat1f& depth_m,
                               std::span<const ReferenceView* const> references, const FreeSpaceOptions& options);

}  // namespace orbslam
