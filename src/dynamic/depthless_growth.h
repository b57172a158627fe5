// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "background_view.h"
#include "camera_motion.h"
#include "orbslam/dynamic/dynamic_detector_options.h"

namespace orbslam {

/// Log-odds of cells without depth, carried over and with this frame's evidence; 0 where there is depth.
cv::Mat1f DepthlessLogOdds(const WorkingFrame& frame, const cv::Mat1f& carried,
                           const BackgroundView& background, const std::vector<TrackedCorner>& corners,
                           const GrowthOptions& options);

/// Grows the moving cells (non-zero), and those without depth that were moving before, into neighbours
/// without depth while the odds are for it. Returns the grown mask.
cv::Mat1b GrowIntoDepthless(const cv::Mat1b& moving, const WorkingFrame& frame, const cv::Mat1f& log_odds,
                            const cv::Mat1f& carried, const GrowthOptions& options);

}  // namespace orbslam
