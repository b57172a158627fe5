// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/util/random.h"

namespace orbslam {

/// A Kinect's depth from exact depth (CV_32FC1, metres): independent normal errors of
/// DepthModel::SigmaM(depth), rounded to 1/5000 m, and 0 outside 0.5 .. 8 m.
void AddKinectNoise(Rng* rng, cv::Mat* depth_m);

/// Adds one normal error a pixel, of sigma grey levels, to all three channels of a CV_8UC3 image.
void AddImageNoise(double sigma, Rng* rng, cv::Mat* bgr);

}  // namespace orbslam
