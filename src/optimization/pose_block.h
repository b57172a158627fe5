// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// A pose as Ceres sees it: two parameter blocks, a quaternion (x y z w, on ceres::EigenQuaternionManifold)
/// and a translation.
struct PoseBlock {
  std::array<double, 4> rotation;
  std::array<double, 3> translation;

  explicit PoseBlock(const Rigid3d& pose)
      : rotation{pose.rotation.x(), pose.rotation.y(), pose.rotation.z(), pose.rotation.w()},
        translation{pose.translation.x(), pose.translation.y(), pose.translation.z()} {}

  Rigid3d Pose() const {
    return {Eigen::Quaterniond(rotation.data()).normalized(), Eigen::Vector3d(translation.data())};
  }
};

}  // namespace orbslam
