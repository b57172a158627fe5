// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

namespace orbslam {

/// [v]x, the matrix with [v]x w = v x w.
Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v);

/// Unit quaternion of the rotation vector w (radians), exact near zero. (Sola et al., "A micro Lie theory",
/// 2018.)
Eigen::Quaterniond So3Exp(const Eigen::Vector3d& w);

/// Rotation vector (radians, angle in [0, pi]) of a unit quaternion.
Eigen::Vector3d So3Log(const Eigen::Quaterniond& q);

/// J with Exp(w + d) = Exp(J d) Exp(w) for small d. (ibid., equation 145.)
Eigen::Matrix3d So3LeftJacobian(const Eigen::Vector3d& w);

/// Angle between two rotations, radians in [0, pi].
double AngularDistance(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

}  // namespace orbslam
