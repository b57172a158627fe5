// SPDX-License-Identifier: GPL-3.0-or-later
#include "mask_growth.h"

#include <cmath>
#include <vector>

namespace orbslam {

cv::Mat1b GrowMask(const cv::Mat1b& mask, const cv::Mat1f& depth_m, const cv::Mat1f& gray,
                   const MaskGrowthOptions& options) {
  cv::Mat1b grown = mask.clone();
  std::vector<cv::Point> front, next;
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      if (mask(v, u) != 0) front.emplace_back(u, v);
  const cv::Rect inside(0, 0, mask.cols, mask.rows);
  for (int step = 0; step < options.max_steps && !front.empty(); ++step) {
    next.clear();
    for (const cv::Point& cell : front)
      for (const cv::Point& offset : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point neighbor = cell + offset;
        if (!inside.contains(neighbor) || grown(neighbor) != 0 || depth_m(neighbor) > 0) continue;
        if (step >= options.free_steps && std::abs(gray(neighbor) - gray(cell)) > options.max_gray_step) continue;
        grown(neighbor) = 255;
        next.push_back(neighbor);
      }
    std::swap(front, next);
  }
  return grown;
}

}  // namespace orbslam
