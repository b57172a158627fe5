// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/sized_cost_function.h>

#include <cmath>

#include "optimization/quaternion_rotation.h"
#include "orbslam/camera/stereo_intrinsics.h"
#include "orbslam/optimization/bundle_adjuster.h"

namespace orbslam {

/// Reprojection error (u, v, disparity) over its standard deviation; the third is 0 for a keypoint without
/// depth, and its square weighs depth_weight times as much as the others'. Parameters: rotation (quaternion x
/// y z w) and translation of camera_from_world, the point in the world. Behind the camera and too near
/// (NearestUsableM) the error is a constant, so that no step gains by moving a point there.
///
/// Everything is 3 wide for speed: Ceres' Schur elimination is compiled for blocks of 3 x 3, while a mixture
/// of 2 and 3 rows or pose blocks of 6 falls back to loops of run-time size, which take twice as long.
class ReprojectionCost final : public ceres::SizedCostFunction<3, 4, 3, 3> {
 public:
  ReprojectionCost(const StereoIntrinsics& intrinsics, const BundleObservation& observation,
                   double depth_weight = 1)
      : intrinsics_(&intrinsics),
        pixel_(observation.pixel),
        weight_(Eigen::Vector3d::Constant(std::sqrt(observation.inverse_variance))) {
    const bool has_depth = observation.pixel.z() >= 0;
    weight_.z() *= has_depth ? std::sqrt(depth_weight) : 0;  // no depth: no derivative either
  }

  /// An inactive one is zero everywhere.
  void SetActive(bool active) { is_active_ = active; }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const QuaternionRotation rotation(parameters[0]);
    const Eigen::Map<const Eigen::Vector3d> translation(parameters[1]), point(parameters[2]);
    const Eigen::Vector3d x = rotation.matrix * point + translation;
    if (!is_active_ || x.z() < NearestUsableM(pixel_)) {
      SetFlat(is_active_ ? kErrorBehind : 0.0, residuals, jacobians);
      return true;
    }
    Eigen::Map<Eigen::Vector3d> error(residuals);
    error = weight_.cwiseProduct(intrinsics_->ReprojectionError(x, pixel_));
    if (jacobians == nullptr) return true;

    const Eigen::Matrix3d projection = ProjectionJacobian(x);
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMajor<4>> j(jacobians[0]);
      j.noalias() = projection.lazyProduct(rotation.Derivative(point));
    }
    if (jacobians[1] != nullptr) Eigen::Map<RowMajor<3>>{jacobians[1]} = projection;
    if (jacobians[2] != nullptr) {
      Eigen::Map<RowMajor<3>> j(jacobians[2]);
      j.noalias() = projection.lazyProduct(rotation.matrix);
    }
    return true;
  }

 private:
  static constexpr double kErrorBehind = 30;  // standard deviations
  template <int kColumns>
  using RowMajor = Eigen::Matrix<double, 3, kColumns, Eigen::RowMajor>;

  static void SetFlat(double error, double* residuals, double** jacobians) {
    residuals[0] = error;
    residuals[1] = residuals[2] = 0;
    if (jacobians == nullptr) return;
    if (jacobians[0] != nullptr) Eigen::Map<RowMajor<4>>{jacobians[0]}.setZero();
    if (jacobians[1] != nullptr) Eigen::Map<RowMajor<3>>{jacobians[1]}.setZero();
    if (jacobians[2] != nullptr) Eigen::Map<RowMajor<3>>{jacobians[2]}.setZero();
  }

  Eigen::Matrix3d ProjectionJacobian(const Eigen::Vector3d& x) const {
    const double inverse_z = 1 / x.z();
    const double a = intrinsics_->fx * inverse_z, b = -a * x.x() * inverse_z;
    const double c = intrinsics_->fy * inverse_z, d = -c * x.y() * inverse_z;
    const double e = -intrinsics_->bf * inverse_z * inverse_z;
    Eigen::Matrix3d j;
    j << weight_[0] * a, 0, weight_[0] * b,  //
        0, weight_[1] * c, weight_[1] * d,   //
        0, 0, weight_[2] * e;
    return j;
  }

  const StereoIntrinsics* intrinsics_;
  Eigen::Vector3d pixel_, weight_;
  bool is_active_ = true;
};

}  // namespace orbslam
