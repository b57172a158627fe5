// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {


/// Sums the normal equations of many residuals that depend on one pose through points y rotated by it:
/// d residual = J (d_w x y + d_t). A sum of 27 numbers replaces the tall Jacobian.
struct PoseNormalEquations {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();  // blocks of the Hessian; only ...
  Eigen::Matrix3d mixed = Eigen::Matrix3d::Zero();     // ... its rows of w, columns of t
  Eigen::Matrix3d translation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient_w = Eigen::Vector3d::Zero(), gradient_t = Eigen::Vector3d::Zero();
  double cost = 0;  // sum of rho(chi-square)

  /// Adds a residual's J'WJ (3 x 3, symmetric) and J'Wr.
  void Add(const Eigen::Vector3d& y, const Eigen::Matrix3d& jtj, const Eigen::Vector3d& jtr) {
    Eigen::Matrix3d crossed;
    for (int i = 0; i < 3; ++i) crossed.col(i) = y.cross(jtj.col(i));
    const Eigen::Matrix3d rows = crossed.transpose();
    translation += jtj;
    mixed += crossed;
    for (int i = 0; i < 3; ++i) rotation.col(i) += y.cross(rows.col(i));
    gradient_w += y.cross(jtr);
    gradient_t += jtr;
  }

  /// J'WJ of all, by (d_w, d_t).
  Matrix6d Hessian() const;

  /// The same least-squares problem in 7 residuals and 6 parameters (w, t): J'J, J'r and r'r are those of the
  /// sums once d_w is d_w = left_jacobian * d_parameters. Six rows are a square root of the Hessian, the
  /// seventh holds the cost that no step can remove. jacobian is 7 x 6, column-major.
  void WriteCompressed(const Eigen::Matrix3d& left_jacobian, double* residuals, double* jacobian) const;
};

}  // namespace orbslam
