// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/mask_warp.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

constexpr int kStridePx = 4;  // one of kStridePx^2 pixels is moved, with its surroundings
constexpr int kPatchPx = 8;   // side of what is marked there: no gaps where the object comes nearer

const DynamicObject* Nearest(const std::vector<DynamicObject>& objects, const Eigen::Vector3d& x) {
  const auto distance = [&](const DynamicObject& object) { return (object.centroid_m - x).squaredNorm(); };
  const auto nearest = std::ranges::min_element(objects, {}, distance);
  return nearest == objects.end() ? nullptr : &*nearest;
}

/// Where the thing seen at an undistorted pixel will be after dt_s, in the earlier camera's frame.
Eigen::Vector3d MovedPoint(const DynamicMask& last, const PinholeCamera& camera, const cv::Point2f& pixel,
                           double depth_m, double dt_s) {
  constexpr double kSomeDepthM = 1.5;  // of an object without any depth
  Eigen::Vector3d x = camera.Unproject(pixel.x, pixel.y, depth_m > 0 ? depth_m : kSomeDepthM);
  const DynamicObject* object = Nearest(last.objects, x);
  if (object == nullptr) return x;
  if (!(depth_m > 0) && object->centroid_m.z() > 0) x *= object->centroid_m.z() / x.z();
  return x + dt_s * object->velocity_mps;
}

}  // namespace

cv::Mat WarpMask(const DynamicMask& last, const RgbdImage& image, const Rigid3d& now_from_last, double dt_s,
                 const PinholeCamera& camera) {
  if (last.mask.empty()) return {};
  std::vector<cv::Point2f> raw;
  for (int v = kStridePx / 2; v < last.mask.rows; v += kStridePx) {
    for (int u = kStridePx / 2; u < last.mask.cols; u += kStridePx) {
      if (last.mask.at<uint8_t>(v, u) != 0) raw.emplace_back(static_cast<float>(u), static_cast<float>(v));
    }
  }
  cv::Mat warped = cv::Mat::zeros(last.mask.size(), CV_8UC1);
  const std::vector<cv::Point2f> undistorted = camera.Undistort(raw);
  for (size_t i = 0; i < raw.size(); ++i) {
    const double depth_m = image.depth_m.at<float>(cv::Point(raw[i]));
    const Eigen::Vector3d x = now_from_last * MovedPoint(last, camera, undistorted[i], depth_m, dt_s);
    if (x.z() <= 0) continue;
    const Eigen::Vector2d pixel = camera.Distort(camera.Project(x));
    if (!pixel.allFinite() || pixel.cwiseAbs().maxCoeff() > 1e5) continue;
    const cv::Point corner(static_cast<int>(std::lround(pixel.x())) - kPatchPx / 2,
                           static_cast<int>(std::lround(pixel.y())) - kPatchPx / 2);
    cv::rectangle(warped, {corner, cv::Size(kPatchPx, kPatchPx)}, 255, cv::FILLED);
  }
  return warped;
}

}  // namespace orbslam
