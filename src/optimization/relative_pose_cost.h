// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Geometry>
#include <cmath>

#include "optimization/quaternion_rotation.h"
#include "orbslam/optimization/pose_graph.h"

namespace orbslam {

/// Rotation vector of a quaternion and its derivative by (x, y, z, w), exact also off the unit sphere.
inline Eigen::Vector3d QuaternionLog(Eigen::Quaterniond q, Eigen::Matrix<double, 3, 4>* derivative) {
  const double sign = q.w() < 0 ? -1 : 1;  // q and -q turn alike: take the shorter way
  const Eigen::Vector3d v = sign * q.vec();
  const double w = sign * q.w(), sine2 = v.squaredNorm(), norm2 = sine2 + w * w;
  // Log = k v with k = 2 atan2(|v|, w) / |v|; dk is (d k / d |v|) / |v|. Near |v| = 0: their Taylor series.
  double k = 2 / w * (1 - sine2 / (3 * w * w)), dk = -4 / (3 * w * w * w);
  if (sine2 > 1e-8) {
    k = 2 * std::atan2(std::sqrt(sine2), w) / std::sqrt(sine2);
    dk = (2 * w / norm2 - k) / sine2;
  }
  derivative->leftCols<3>() = sign * (dk * v * v.transpose());
  derivative->diagonal().array() += sign * k;
  derivative->col(3) = -sign * 2 / norm2 * v;
  return k * v;
}

/// By how much two poses disagree with a measured motion between them: rotation vector of (b_from_a as posed)
/// times (measured a_from_b), and the difference of translations; in units of the options' scales.
/// Parameters: rotation (quaternion x y z w) and translation of a, then of b; both camera_from_world.
class RelativePoseCost final : public ceres::SizedCostFunction<6, 4, 3, 4, 3> {
 public:
  RelativePoseCost(const PoseGraphEdge& edge, const PoseGraphOptions& options)
      : measured_(edge.b_from_a),
        rotation_weight_(std::sqrt(edge.weight) / options.rotation_scale_rad),
        translation_weight_(std::sqrt(edge.weight) / options.translation_scale_m) {}

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    EvaluateRotation(parameters, residuals, jacobians);
    EvaluateTranslation(parameters, residuals + 3, jacobians);
    return true;
  }

 private:
  template <int kColumns>
  using RowMajor = Eigen::Matrix<double, 6, kColumns, Eigen::RowMajor>;
  using Quaternion = Eigen::Map<const Eigen::Quaterniond>;

  /// p * q = Left(p) q, in x y z w order.
  static Eigen::Matrix4d Left(const Eigen::Quaterniond& p) {
    Eigen::Matrix4d m;
    m.topLeftCorner<3, 3>() = CrossMatrix(p.vec());
    m.topRightCorner<3, 1>() = p.vec();
    m.bottomLeftCorner<1, 3>() = -p.vec().transpose();
    m(3, 3) = 0;
    m.diagonal().array() += p.w();
    return m;
  }

  /// p * q = Right(q) p.
  static Eigen::Matrix4d Right(const Eigen::Quaterniond& q) {
    Eigen::Matrix4d m = Left(q);
    m.topLeftCorner<3, 3>().transposeInPlace();
    return m;
  }

  static Eigen::Vector4d ConjugateSigns() { return {-1, -1, -1, 1}; }

  void EvaluateRotation(const double* const* parameters, double* residuals, double** jacobians) const {
    const Quaternion a(parameters[0]), b(parameters[2]);
    const Eigen::Quaterniond a_from_b = measured_.rotation.conjugate();
    Eigen::Matrix<double, 3, 4> derivative;
    Eigen::Map<Eigen::Vector3d>{residuals} =
        rotation_weight_ * QuaternionLog(b * a.conjugate() * a_from_b, &derivative);
    if (jacobians == nullptr) return;
    derivative *= rotation_weight_;
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMajor<4>>{jacobians[0]}.topRows<3>() =
          derivative * Left(b) * Right(a_from_b) * ConjugateSigns().asDiagonal();
    }
    if (jacobians[1] != nullptr) Eigen::Map<RowMajor<3>>{jacobians[1]}.topRows<3>().setZero();
    if (jacobians[2] != nullptr) {
      Eigen::Map<RowMajor<4>>{jacobians[2]}.topRows<3>() = derivative * Right(a.conjugate() * a_from_b);
    }
    if (jacobians[3] != nullptr) Eigen::Map<RowMajor<3>>{jacobians[3]}.topRows<3>().setZero();
  }

  void EvaluateTranslation(const double* const* parameters, double* residuals, double** jacobians) const {
    const Eigen::Quaterniond a_inverse = Quaternion(parameters[0]).conjugate();
    const QuaternionRotation world_from_a(a_inverse.coeffs().data()), b(parameters[2]);
    const Eigen::Map<const Eigen::Vector3d> t_a(parameters[1]), t_b(parameters[3]);
    const Eigen::Vector3d turned = world_from_a.matrix * t_a;
    Eigen::Map<Eigen::Vector3d>{residuals} =
        translation_weight_ * (t_b - b.matrix * turned - measured_.translation);
    if (jacobians == nullptr) return;
    if (jacobians[0] != nullptr) {
      Eigen::Map<RowMajor<4>>{jacobians[0]}.bottomRows<3>() =
          -translation_weight_ * b.matrix * world_from_a.Derivative(t_a) * ConjugateSigns().asDiagonal();
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<RowMajor<3>>{jacobians[1]}.bottomRows<3>() =
          -translation_weight_ * b.matrix * world_from_a.matrix;
    }
    if (jacobians[2] != nullptr) {
      Eigen::Map<RowMajor<4>>{jacobians[2]}.bottomRows<3>() = -translation_weight_ * b.Derivative(turned);
    }
    if (jacobians[3] != nullptr) {
      Eigen::Map<RowMajor<3>>{jacobians[3]}.bottomRows<3>() =
          translation_weight_ * Eigen::Matrix3d::Identity();
    }
  }

  Rigid3d measured_;
  double rotation_weight_, translation_weight_;
};

}  // namespace orbslam
