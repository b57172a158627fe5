// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimization/pose_normal_equations.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace orbslam {

Matrix6d PoseNormalEquations::Hessian() const {
  Matrix6d hessian;
  hessian << rotation, mixed, mixed.transpose(), translation;
  return hessian;
}

void PoseNormalEquations::WriteCompressed(const Eigen::Matrix3d& left_jacobian, double* residuals,
                                          double* jacobian) const {
  Matrix6d hessian;
  hessian.topLeftCorner<3, 3>() = left_jacobian.transpose() * rotation * left_jacobian;
  hessian.topRightCorner<3, 3>() = left_jacobian.transpose() * mixed;
  hessian.bottomLeftCorner<3, 3>() = hessian.topRightCorner<3, 3>().transpose();
  hessian.bottomRightCorner<3, 3>() = translation;
  Vector6d gradient;
  gradient << left_jacobian.transpose() * gradient_w, gradient_t;

  // H = P' L D L' P, so J = sqrt(D) L' P and r = D^-1/2 L^-1 P g. Pivoting keeps a singular H harmless.
  const Eigen::LDLT<Matrix6d> ldlt(hessian);
  const Vector6d pivots = ldlt.vectorD();
  const Vector6d forward = ldlt.matrixL().solve(ldlt.transpositionsP() * gradient);
  const Matrix6d upper = Matrix6d(ldlt.matrixU()) * (ldlt.transpositionsP() * Matrix6d::Identity());
  const double smallest = 1e-14 * pivots.cwiseAbs().maxCoeff();

  Eigen::Map<Eigen::Matrix<double, 7, 6>> j(jacobian);
  Eigen::Map<Eigen::Matrix<double, 7, 1>> r(residuals);
  j.setZero();
  r.setZero();
  for (int i = 0; i < 6; ++i) {
    if (!(pivots[i] > smallest)) continue;
    const double root = std::sqrt(pivots[i]);
    j.row(i) = root * upper.row(i);
    r[i] = forward[i] / root;
  }
  r[6] = std::sqrt(std::max(0.0, cost - r.squaredNorm()));
}

}  // namespace orbslam
