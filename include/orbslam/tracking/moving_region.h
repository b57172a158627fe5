// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// What a frame says of places in space, where objects move: asked for in camera coordinates, metres.
class MovingRegion {
 public:
  /// px. How far masks and depth may be off: both are coarser than the picture, and masks are widened, so
  /// that their rim shows what is behind.
  static constexpr int kRimPx = 8;
  static constexpr double kStepM = 0.15;  // how far who walks briskly (1.5 m/s) gets in three frames

  /// mask: CV_8UC1, non-zero on moving objects, or empty: nothing moves. depth_m: CV_32FC1, metres, 0: none;
  /// or empty. Both of the raw image's size, and not copied: they must not change.
  MovingRegion(const Sensor& sensor, const cv::Mat& mask, const cv::Mat& depth_m);

  bool IsEmpty() const { return mask_.empty(); }
  /// A static point at x_camera (camera frame, metres, z > 0) is hidden: its pixel is covered.
  bool Covers(const Eigen::Vector3d& x_camera) const;
  /// The moving object itself is at x_camera: the pixel is well inside of the mask, and its depth is the
  /// point's within 3 sigma of the depth camera, and of what one pixel changes on a steep surface.
  bool Shows(const Eigen::Vector3d& x_camera) const { return IsShownWithin(0, x_camera); }
  /// The object may have been at x_camera a moment ago: as Shows, but kStepM nearer or farther.
  bool MayShow(const Eigen::Vector3d& x_camera) const { return IsShownWithin(kStepM, x_camera); }
  /// Nothing is at x_camera any more: for kRimPx around, off the mask, all measured depths lie clearly
  /// behind.
  bool SeesThrough(const Eigen::Vector3d& x_camera) const;

 private:
  cv::Point RawPixel(const Eigen::Vector3d& x_camera) const;
  bool IsShownWithin(double step_m, const Eigen::Vector3d& x_camera) const;
  double ToleranceM(double depth_m) const;

  const Sensor* sensor_;
  cv::Mat mask_, core_, depth_m_;
};

}  // namespace orbslam
