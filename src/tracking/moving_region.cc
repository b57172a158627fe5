// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/moving_region.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

constexpr double kThinnestM = 0.05;  // of limbs. Nearer to what is behind, a point may just be placed badly
constexpr int kStepPx = 2;           // from sample to sample: depth cameras measure nothing thinner
constexpr int kSamplesPerSide = 2 * MovingRegion::kRimPx / kStepPx + 1;
constexpr int kMinSamples = kSamplesPerSide * kSamplesPerSide / 2;

bool IsSet(const cv::Mat& mask, const cv::Point& pixel) {
  return pixel.inside({0, 0, mask.cols, mask.rows}) && mask.at<uint8_t>(pixel) != 0;
}

}  // namespace

MovingRegion::MovingRegion(const Sensor& sensor, const cv::Mat& mask, const cv::Mat& depth_m)
    : sensor_(&sensor), mask_(mask), depth_m_(depth_m) {
  if (mask.empty()) return;
  const cv::Size side(2 * kRimPx + 1, 2 * kRimPx + 1);
  cv::erode(mask, core_, cv::getStructuringElement(cv::MORPH_RECT, side));
}

cv::Point MovingRegion::RawPixel(const Eigen::Vector3d& x_camera) const {
  const Eigen::Vector2d raw = sensor_->camera.Distort(sensor_->camera.Project(x_camera));
  return {static_cast<int>(std::lround(raw.x())), static_cast<int>(std::lround(raw.y()))};
}

bool MovingRegion::Covers(const Eigen::Vector3d& x_camera) const {
  return !IsEmpty() && IsSet(mask_, RawPixel(x_camera));
}

bool MovingRegion::IsShownWithin(double step_m, const Eigen::Vector3d& x_camera) const {
  if (IsEmpty()) return false;
  const cv::Point pixel = RawPixel(x_camera);
  if (!IsSet(core_, pixel)) return false;
  const double depth_m = depth_m_.at<float>(pixel);
  return depth_m > 0 && std::abs(depth_m - x_camera.z()) < ToleranceM(x_camera.z()) + step_m;
}

bool MovingRegion::SeesThrough(const Eigen::Vector3d& x_camera) const {
  if (depth_m_.empty()) return false;
  const cv::Point pixel = RawPixel(x_camera);
  const double behind_m = x_camera.z() + std::max(kThinnestM, ToleranceM(x_camera.z()));
  int num_behind = 0;
  for (int v = -kRimPx; v <= kRimPx; v += kStepPx) {
    for (int u = -kRimPx; u <= kRimPx; u += kStepPx) {
      const cv::Point at = pixel + cv::Point(u, v);
      if (!at.inside({0, 0, depth_m_.cols, depth_m_.rows}) || IsSet(mask_, at)) continue;
      const double depth_m = depth_m_.at<float>(at);
      if (depth_m > 0 && depth_m < behind_m) return false;
      num_behind += depth_m > 0;
    }
  }
  return num_behind > kMinSamples;
}

/// 3 sigma of the depth camera, and of what one pixel changes on a steep surface.
double MovingRegion::ToleranceM(double depth_m) const {
  return 3 * (DepthModel::SigmaM(depth_m) + depth_m / sensor_->camera.fx);
}

}  // namespace orbslam
