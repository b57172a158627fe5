// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

namespace orbslam {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid motion b_from_a: x_b = rotation * x_a + translation, so that c_from_a = c_from_b * b_from_a.
/// rotation is a unit quaternion; translation in metres.
struct Rigid3d {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Matrix3d RotationMatrix() const { return rotation.toRotationMatrix(); }
};

inline Eigen::Vector3d operator*(const Rigid3d& b_from_a, const Eigen::Vector3d& x_a) {
  return b_from_a.rotation * x_a + b_from_a.translation;
}

/// The product is renormalised, so that long chains stay rigid.
inline Rigid3d operator*(const Rigid3d& c_from_b, const Rigid3d& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

inline Rigid3d Inverse(const Rigid3d& b_from_a) {
  const Eigen::Quaterniond a_from_b = b_from_a.rotation.conjugate();
  return {a_from_b, -(a_from_b * b_from_a.translation)};
}

/// The least-squares b_from_a of paired points, columns of two 3 x N matrices, N >= 3
/// (Umeyama, PAMI 1991, without scale).
Rigid3d AlignPoints(const Eigen::Matrix3Xd& points_b, const Eigen::Matrix3Xd& points_a);

}  // namespace orbslam
