// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

namespace orbslam {

struct MaskGrowthOptions {
  int max_steps = 12;                // cells: how far into pixels without depth
  int free_steps = 3;                // cells: silhouettes that the sensor loses
  float max_gray_step = 15.f;        // grey levels between neighbours of one thing, after that
};

/// Grows a mask of cells into neighbouring cells without depth.
cv::Mat1b GrowMask(const cv::Mat1b& mask, const cv::Mat1f& depth_m, const cv::Mat1f& gray,
                   const MaskGrowthOptions& options);

}  // namespace orbslam
