// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "orbslam/dynamic/dynamic_detector_options.h"
#include "reference_view.h"

namespace orbslam {

/// What the references say of each cell of the present frame.
struct FreeSpaceVotes {
  cv::Mat1b num_free;              // half votes of the references that saw through it
  cv::Mat1b num_static;            // references that saw it there, not moving: one for each
  cv::Mat1b suspicious;            // non-zero: stands in space that was free
  cv::Mat1b confirmed_static;      // non-zero: was there before, and nobody saw through it
};

FreeSpaceVotes VoteOnFreeSpace(const GridCamera& camera, const cv::Mat1f& depth_m,
                               std::span<const ReferenceView* const> references,
                               const FreeSpaceOptions& options);

/// Takes back what says that these cells (non-zero) are static; what says that they are not stays.
void WithdrawStatic(const cv::Mat1b& cells, FreeSpaceVotes* votes);

}  // namespace orbslam
