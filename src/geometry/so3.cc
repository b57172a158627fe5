// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/so3.h"

#include <cmath>

namespace orbslam {

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond So3Exp(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  // sin(a/2)/a and its Taylor series; at 1e-4 the first dropped term is below 1e-18.
  const double k = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return Eigen::Quaterniond(std::cos(0.5 * angle), k * w.x(), k * w.y(), k * w.z()).normalized();
}

Eigen::Vector3d So3Log(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * q.vec();
  const double sine = v.norm();
  const double w = sign * q.w();
  return sine < 1e-12 ? Eigen::Vector3d(2.0 * v) : Eigen::Vector3d(v * (2.0 * std::atan2(sine, w) / sine));
}

Eigen::Matrix3d So3LeftJacobian(const Eigen::Vector3d& w) {
  const double angle2 = w.squaredNorm();
  const Eigen::Matrix3d wx = CrossMatrix(w);
  if (angle2 < 1e-8) return Eigen::Matrix3d::Identity() + 0.5 * wx + wx * wx / 6.0;
  const double angle = std::sqrt(angle2);
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle2 * wx +
         (angle - std::sin(angle)) / (angle2 * angle) * wx * wx;
}

double AngularDistance(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return So3Log(a.conjugate() * b).norm();
}

}  // namespace orbslam
