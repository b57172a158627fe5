// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "corner_gate.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "working_frame.h"

namespace orbslam {

/// Cells (non-zero) on a surface that slides within itself. The inside of somebody's back is where a back was
/// a moment ago although he walks: there an unchanged depth says nothing, and only texture tells. A surface
/// slides around a corner that moves, if its neighbours of similar depth do so too, and alike.
cv::Mat1b SlidingCells(const cv::Mat1f& depth_m, const Flow& flow, const SlidingOptions& options);

}  // namespace orbslam
