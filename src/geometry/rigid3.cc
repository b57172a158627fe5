// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/rigid3.h"

#include "orbslam/util/check.h"

namespace orbslam {

Rigid3d AlignPoints(const Eigen::Matrix3Xd& points_b, const Eigen::Matrix3Xd& points_a) {
  ORBSLAM_CHECK(points_a.cols() == points_b.cols() && points_a.cols() >= 3);
  const Eigen::Matrix4d m = Eigen::umeyama(points_a, points_b, /*with_scaling=*/false);
  return {Eigen::Quaterniond(m.topLeftCorner<3, 3>()).normalized(), m.topRightCorner<3, 1>()};
}

}  // namespace orbslam
