// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/triangulation.h"

#include "orbslam/geometry/so3.h"

namespace orbslam {

std::optional<Eigen::Vector3d> TriangulateMidpoint(const Rigid3d& a_from_b,
                                                   const Eigen::Vector3d& direction_a,
                                                   const Eigen::Vector3d& direction_b) {
  const Eigen::Vector3d d = direction_a.normalized();
  const Eigen::Vector3d e = (a_from_b.rotation * direction_b).normalized();
  const Eigen::Vector3d& baseline = a_from_b.translation;
  // s d and baseline + t e are nearest where their difference is normal to d and e.
  const double de = d.dot(e);
  const double determinant = 1.0 - de * de;
  if (determinant < 1e-12) return std::nullopt;
  const double s = (baseline.dot(d) - de * baseline.dot(e)) / determinant;
  const double t = (de * baseline.dot(d) - baseline.dot(e)) / determinant;
  if (s <= 0 || t <= 0) return std::nullopt;
  return 0.5 * (s * d + baseline + t * e);
}

Eigen::Matrix3d EssentialMatrix(const Rigid3d& b_from_a) {
  return CrossMatrix(b_from_a.translation) * b_from_a.RotationMatrix();
}

}  // namespace orbslam
