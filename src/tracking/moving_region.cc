// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/moving_region.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

// px. Masks are made on a coarser grid and widened, so that their rim shows what is behind.
constexpr int kRimPx = 8;

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

bool MovingRegion::Shows(const Eigen::Vector3d& x_camera) const {
  if (IsEmpty()) return false;
  const cv::Point pixel = RawPixel(x_camera);
  if (!IsSet(core_, pixel)) return false;
  const double depth_m = depth_m_.at<float>(pixel);
  const double pixel_m = x_camera.z() / sensor_->camera.fx;
  return depth_m > 0 && std::abs(depth_m - x_camera.z()) < 3 * (DepthModel::SigmaM(x_camera.z()) + pixel_m);
}

}  // namespace orbslam
