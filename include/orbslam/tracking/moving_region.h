// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// The part of a frame that moving objects cover, asked for in undistorted pixels and camera coordinates.
class MovingRegion {
 public:
  /// mask: CV_8UC1, non-zero on moving objects, or empty: nothing moves. depth_m: CV_32FC1, metres, 0: none.
  /// Both of the raw image's size, and not copied: they must not change.
  MovingRegion(const Sensor& sensor, const cv::Mat& mask, const cv::Mat& depth_m);

  bool IsEmpty() const { return mask_.empty(); }
  /// A static point at x_camera (camera frame, metres, z > 0) is hidden: its pixel is covered.
  bool Covers(const Eigen::Vector3d& x_camera) const;
  /// The moving object itself is at x_camera: the pixel is well inside of the mask, and its depth is the
  /// point's within 3 sigma of the depth camera, and of what one pixel changes on a steep surface.
  bool Shows(const Eigen::Vector3d& x_camera) const;

 private:
  cv::Point RawPixel(const Eigen::Vector3d& x_camera) const;

  const Sensor* sensor_;
  cv::Mat mask_, core_, depth_m_;
};

}  // namespace orbslam
