// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/types.hpp>
#include <vector>

namespace orbslam {

/// A pinhole camera with radial-tangential (Brown-Conrady) distortion, OpenCV's model. Camera frame: x right,
/// y down, z forward, metres. Pixel (u, v): the centre of the top left pixel is (0, 0). Everything after
/// feature extraction works in *undistorted* pixels: those that the same pinhole without distortion would
/// see.
struct PinholeCamera {
  int width = 0, height = 0;              // px
  double fx = 0, fy = 0, cx = 0, cy = 0;  // px
  std::array<double, 5> distortion{};     // k1 k2 p1 p2 k3
  double readout_s = 0;  // of a rolling shutter, from the first row to the last; 0: all rows at once

  bool IsDistorted() const;

  /// Undistorted pixel of a point in the camera frame; z must be positive.
  Eigen::Vector2d Project(const Eigen::Vector3d& x_camera) const {
    return {fx * x_camera.x() / x_camera.z() + cx, fy * x_camera.y() / x_camera.z() + cy};
  }
  /// The point in the camera frame at depth_m (along z) behind an undistorted pixel.
  Eigen::Vector3d Unproject(double u, double v, double depth_m) const {
    return {(u - cx) / fx * depth_m, (v - cy) / fy * depth_m, depth_m};
  }
  /// Distorted (raw image) pixel of an undistorted one.
  Eigen::Vector2d Distort(const Eigen::Vector2d& undistorted) const;
  /// Undistorted pixels of raw image pixels.
  std::vector<cv::Point2f> Undistort(const std::vector<cv::Point2f>& raw) const;
};

/// The rectangle, in undistorted pixels, that the image's corners span.
struct ImageBounds {
  float min_u = 0, min_v = 0, max_u = 0, max_v = 0;

  bool Contains(float u, float v) const { return u >= min_u && u < max_u && v >= min_v && v < max_v; }
};
ImageBounds UndistortedBounds(const PinholeCamera& camera);

}  // namespace orbslam
