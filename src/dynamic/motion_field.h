// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "camera_motion.h"

namespace orbslam {

/// Where what moves came from: for each cell the shift, in cells, to its place in the last frame, from the
/// nearest corners that lay on moving things; where there are none, from all corners.
cv::Mat2f BackwardMotion(cv::Size cells, const std::vector<TrackedCorner>& corners);

/// image(cell + shift(cell)), nearest; what comes from outside gets half of the value at the rim.
cv::Mat1f CarryOver(const cv::Mat1f& image, const cv::Mat2f& shift);

}  // namespace orbslam
