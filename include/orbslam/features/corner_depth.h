// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/camera/depth_model.h"

namespace orbslam {

/// The depth of a corner at a raw pixel of a depth image, CV_32FC1, metres; -1: none there, or outside.
///
/// Depth cameras see silhouettes ragged, two pixels to either side, and a corner on one belongs to what is in
/// front, whose motion it shows; read from behind, it would be too far, always, and the camera's path too
/// long. So where depth jumps within two pixels, by more than the pixel of disparity that a depth is worth,
/// it is that of what is in front there.
float CornerDepthM(const cv::Mat& depth_m, const cv::Point& pixel, const DepthModel& model);

}  // namespace orbslam
