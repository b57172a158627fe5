// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "camera_motion.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "working_frame.h"

namespace orbslam {

/// From which residual on a corner moves: as many times the median of those that rested in the last mask, so
/// that it is as sensitive as this frame's flow and camera motion are exact.
struct CornerGate {
  float moving_px = 0;  // grey px
  float sharpness = 1;  // 1 in a sharp picture; below, as many times less exact

  bool IsSharp() const { return sharpness >= 1; }
};
CornerGate MakeCornerGate(std::span<const TrackedCorner> corners, const SlidingOptions& options);

/// Cells (non-zero) on a surface that slides within itself. The inside of somebody's back is where a back was
/// a moment ago although he walks: there an unchanged depth says nothing, and only texture tells. A surface
/// slides around a corner that moves, if its neighbours of similar depth do so too, and alike.
cv::Mat1b SlidingCells(const cv::Mat1f& depth_m, std::span<const TrackedCorner> corners, float moving_px,
                       const SlidingOptions& options);

}  // namespace orbslam
