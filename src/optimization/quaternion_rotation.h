// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "orbslam/geometry/so3.h"

namespace orbslam {

/// The rotation R(q) v = v + 2 w (u x v) + 2 u x (u x v) of q = (u, w), and its derivatives. They are those
/// of this formula in four free numbers, also off the unit sphere: numeric differentiation agrees, and the
/// manifold's tangent directions see the right thing.
struct QuaternionRotation {
  Eigen::Vector3d u;
  double w;
  Eigen::Matrix3d matrix;

  /// Eigen's storage: x y z w.
  explicit QuaternionRotation(const double* xyzw) : u(xyzw[0], xyzw[1], xyzw[2]), w(xyzw[3]) {
    matrix.noalias() = 2 * u * u.transpose() + 2 * w * CrossMatrix(u);  // [u]x^2 = u u' - |u|^2 I
    matrix.diagonal().array() += 1 - 2 * u.squaredNorm();
  }

  /// d (R(q) v) / d (x, y, z, w).
  Eigen::Matrix<double, 3, 4> Derivative(const Eigen::Vector3d& v) const {
    Eigen::Matrix<double, 3, 4> d;
    d.leftCols<3>() = 2 * (u * v.transpose() - 2 * v * u.transpose() - w * CrossMatrix(v));
    d.diagonal().array() += 2 * u.dot(v);
    d.col(3) = 2 * u.cross(v);
    return d;
  }
};

}  // namespace orbslam
