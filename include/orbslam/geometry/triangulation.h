// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// The point, in frame a, that is nearest to two rays: from a's origin along direction_a, and from b's origin
/// along direction_b (given in b); both need not be unit. Midpoint method. Nothing if the rays are parallel,
/// or meet behind a camera.
std::optional<Eigen::Vector3d> TriangulateMidpoint(const Rigid3d& a_from_b,
                                                   const Eigen::Vector3d& direction_a,
                                                   const Eigen::Vector3d& direction_b);

/// E with x_b^T E x_a = 0 for the directions of one point (Longuet-Higgins 1981).
Eigen::Matrix3d EssentialMatrix(const Rigid3d& b_from_a);

}  // namespace orbslam
