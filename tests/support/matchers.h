// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gmock/gmock.h>

#include <ostream>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/geometry/so3.h"
#include "orbslam/util/ids.h"

namespace orbslam {

inline void PrintTo(const Rigid3d& motion, std::ostream* out) {
  *out << "rotation (x y z w) " << motion.rotation.coeffs().transpose() << ", translation "
       << motion.translation.transpose();
}
template <class Tag>
void PrintTo(StrongId<Tag> id, std::ostream* out) {
  id.IsValid() ? *out << id.value : *out << "none";
}

}  // namespace orbslam

namespace orbslam::test {

/// EXPECT_THAT(motion, Rigid3dNear(expected, 0.001, 0.002)): within 1 mm and 2 mrad.
MATCHER_P3(Rigid3dNear, expected, max_distance_m, max_angle_rad,
           "is near " + testing::PrintToString(expected)) {
  const double distance_m = (arg.translation - expected.translation).norm();
  const double angle_rad = AngularDistance(arg.rotation, expected.rotation);
  *result_listener << "is off by " << distance_m << " m and " << angle_rad << " rad";
  return distance_m <= max_distance_m && angle_rad <= max_angle_rad;
}

/// The same number for metres and radians.
inline auto Rigid3dNear(const Rigid3d& expected, double tolerance) {
  return Rigid3dNear(expected, tolerance, tolerance);
}

/// For anything of Eigen: no coefficient differs by more.
MATCHER_P2(MatrixNear, expected, tolerance, "is within " + testing::PrintToString(tolerance)) {
  const double difference = (arg - expected).cwiseAbs().maxCoeff();
  *result_listener << "differs by " << difference;
  return difference <= tolerance;
}

}  // namespace orbslam::test
