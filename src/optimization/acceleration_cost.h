// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/sized_cost_function.h>

#include <array>

#include "orbslam/geometry/so3.h"
#include "orbslam/optimization/trajectory_smoother.h"

namespace orbslam {

/// What a pose is moved by, in the world: rotation vector (rad), translation (m).
using PoseCorrection = std::array<double, 6>;

/// Acceleration over three poses in units of its standard deviation, angular first, as a function of their
/// corrections; as small as these are, it is linear. Velocities are those between poses, in the world.
class AccelerationCost final : public ceres::SizedCostFunction<6, 6, 6, 6> {
 public:
  /// Time stamps must ascend, and the prior know something.
  AccelerationCost(const MotionPrior& prior, const UncertainPose& a, const UncertainPose& b,
                   const UncertainPose& c) {
    const double ab_s = b.timestamp_s - a.timestamp_s, bc_s = c.timestamp_s - b.timestamp_s;
    const double mean_s = (ab_s + bc_s) / 2;
    weights_.head<3>().setConstant(1 / prior.angular_acceleration_radps2);
    weights_.tail<3>().setConstant(1 / prior.acceleration_mps2);
    factors_ = {1 / (ab_s * mean_s), -(1 / ab_s + 1 / bc_s) / mean_s, 1 / (bc_s * mean_s)};
    uncorrected_ = (Motion(b, c) / bc_s - Motion(a, b) / ab_s) / mean_s;
  }

  bool Evaluate(const double* const* corrections, double* residuals, double** jacobians) const override {
    Vector6d acceleration = uncorrected_;
    for (int i = 0; i < 3; ++i) acceleration += factors_[i] * Eigen::Map<const Vector6d>(corrections[i]);
    Eigen::Map<Vector6d>{residuals} = weights_.cwiseProduct(acceleration);
    if (jacobians == nullptr) return true;
    for (int i = 0; i < 3; ++i) {
      if (jacobians[i] == nullptr) continue;
      Eigen::Map<Matrix6d>{jacobians[i]} = Matrix6d((factors_[i] * weights_).asDiagonal());
    }
    return true;
  }

 private:
  static Vector6d Motion(const UncertainPose& a, const UncertainPose& b) {
    const Rigid3d &from = a.world_from_camera, &to = b.world_from_camera;
    Vector6d motion;
    motion << So3Log(to.rotation * from.rotation.conjugate()), to.translation - from.translation;
    return motion;
  }

  Vector6d weights_, uncorrected_;
  std::array<double, 3> factors_;  // of the three poses in an acceleration, 1 / s^2
};

}  // namespace orbslam
