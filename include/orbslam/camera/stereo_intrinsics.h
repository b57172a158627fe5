// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "orbslam/camera/depth_model.h"
#include "orbslam/camera/pinhole_camera.h"

namespace orbslam {

/// The five numbers that reprojection needs: the undistorted pinhole, and bf of the virtual right camera.
struct StereoIntrinsics {
  double fx = 1, fy = 1, cx = 0, cy = 0;  // px
  double bf = 0;                          // baseline * fx, px * m

  StereoIntrinsics() = default;
  StereoIntrinsics(const PinholeCamera& camera, const DepthModel& depth)
      : fx(camera.fx), fy(camera.fy), cx(camera.cx), cy(camera.cy), bf(depth.baseline_times_fx) {}

  /// (u, v, u_right), px, of a point in the camera frame with z > 0.
  Eigen::Vector3d Project(const Eigen::Vector3d& x) const {
    const double u = fx * x.x() / x.z() + cx;
    return {u, fy * x.y() / x.z() + cy, u - bf / x.z()};
  }

  /// Errors of u, v and disparity u - u_right, px, of a point in the camera frame against a measured (u, v,
  /// u_right); the third is 0 where the measured u_right < 0: no depth. A depth camera measures depth
  /// independently of where the corner was found, and disparity stands for it; ORB-SLAM2's error of u_right
  /// contains that of u a second time.
  Eigen::Vector3d ReprojectionError(const Eigen::Vector3d& x, const Eigen::Vector3d& measured) const {
    const double inverse_z = 1.0 / x.z();
    const double disparity = measured.x() - measured.z();
    return {fx * x.x() * inverse_z + cx - measured.x(), fy * x.y() * inverse_z + cy - measured.y(),
            measured.z() < 0 ? 0.0 : bf * inverse_z - disparity};
  }
};

/// Nearer to the camera's plane than this, metres, or behind it, a measured (u, v, u_right) says nothing.
/// Where a depth camera begins to measure (0.4 m: Nguyen, Izadi and Lovell, 3DIMPVT 2012) and has not, there
/// are wrong matches rather than things, and one of those at 5 cm would outweigh a thousand points of a wall.
inline double NearestUsableM(const Eigen::Vector3d& measured) { return measured.z() < 0 ? 0.4 : 1e-3; }

}  // namespace orbslam
