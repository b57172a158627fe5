// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/corner_depth.h"

#include <algorithm>
#include <cmath>

namespace orbslam {
namespace {

constexpr int kReachPx = 2;    // of ragged silhouettes (Kinect: Khoshelham and Elberink, Sensors 2012)
constexpr double kJumpPx = 1;  // of disparity: its standard deviation in the optimisers

/// Disparity, px: what is in front has more of it.
double DisparityAt(const cv::Mat& depth_m, int u, int v, double baseline_times_fx) {
  const float z = depth_m.at<float>(v, u);
  return std::isfinite(z) && z > 0 ? baseline_times_fx / z : 0;
}

}  // namespace

float CornerDepthM(const cv::Mat& depth_m, const cv::Point& pixel, const DepthModel& model) {
  if (!cv::Rect({0, 0}, depth_m.size()).contains(pixel)) return -1;
  const double bf = model.baseline_times_fx, own = DisparityAt(depth_m, pixel.x, pixel.y, bf);
  if (own == 0) return -1;
  const cv::Rect box = cv::Rect(pixel.x - kReachPx, pixel.y - kReachPx, 2 * kReachPx + 1, 2 * kReachPx + 1) &
                       cv::Rect({0, 0}, depth_m.size());
  const auto for_each = [&](auto&& visit) {
    for (int v = box.y; v < box.y + box.height; ++v)
      for (int u = box.x; u < box.x + box.width; ++u)
        if (const double disparity = DisparityAt(depth_m, u, v, bf); disparity > 0) visit(disparity);
  };
  double front = own, back = own;
  for_each([&](double disparity) {
    front = std::max(front, disparity);
    back = std::min(back, disparity);
  });
  if (front - back <= kJumpPx) return depth_m.at<float>(pixel);
  double sum = 0, count = 0;
  for_each([&](double disparity) {
    if (front - disparity > kJumpPx / 2) return;
    sum += disparity;
    ++count;
  });
  return static_cast<float>(bf * count / sum);
}

}  // namespace orbslam
