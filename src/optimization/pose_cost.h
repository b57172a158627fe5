// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/pose_normal_equations.h"
#include "orbslam/camera/stereo_intrinsics.h"
#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// What was measured: (u, v, u_right), undistorted px, u_right < 0 without depth; its weight; its gate.
struct PixelMeasurement {
  Eigen::Vector3d pixel;
  double inverse_variance = 1;  // 1 / px^2
  double max_chi2 = 0;  // beyond it an observation is an outlier; also where Huber's loss turns linear
};

/// Sum of Huber-weighted squared reprojection errors as a function of six numbers (w, t), which move the
/// pose: b_from_a = (Exp(w), t) * prior. Forward observations see points of frame a in camera b, backward
/// ones points of frame b in camera a. It is a function for ceres::TinySolver, compressed to 7 residuals
/// (PoseNormalEquations), so that a solve needs no heap: cost and gradient are exact, the Hessian is that of
/// iteratively reweighted least squares.
class PoseCost {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = 7, NUM_PARAMETERS = 6 };

  /// The pose at some parameters.
  struct State {
    Eigen::Matrix3d rotation;  // of (Exp(w), t)
    Eigen::Vector3d translation;
    Eigen::Matrix3d a_rotation_b;  // of the whole a_from_b
  };

  PoseCost(const StereoIntrinsics& intrinsics, const Rigid3d& b_from_a);

  void Reserve(size_t n) { observations_.reserve(n); }
  void AddForward(const Eigen::Vector3d& x_a, const PixelMeasurement& seen_in_b);
  void AddBackward(const Eigen::Vector3d& x_b, const PixelMeasurement& seen_in_a);
  int NumObservations() const { return static_cast<int>(observations_.size()); }

  /// Only active observations count; all are after being added.
  void SetActive(int i, bool active) { observations_[i].is_active = active; }
  bool IsActive(int i) const { return observations_[i].is_active; }
  void SetRobust(bool robust) { is_robust_ = robust; }

  State At(const Vector6d& parameters) const;
  Rigid3d PoseAt(const Vector6d& parameters) const;
  /// Squared normalised error; infinite where NearestUsableM says so or if anything is not finite.
  double Chi2(int i, const State& state) const;
  std::vector<double> Chi2(const State& state) const;  // of each
  /// From now on gates, and with them the loss, are in units of the noise that these errors show.
  void AdaptGates(const std::vector<double>& chi2);
  bool IsWithinGate(int i, double chi2) const { return chi2 <= noise_variance_ * observations_[i].max_chi2; }

  /// Inverse covariance of (w, t) at a state, of what is active.
  Matrix6d Information(const State& state) const;

  /// residuals: 7; jacobian: 7 x 6 column-major or null.
  bool operator()(const double* parameters, double* residuals, double* jacobian) const;

 private:
  struct Observation {
    Eigen::Vector3d point;  // forward: in frame b by the prior; backward: in frame b
    Eigen::Vector3d pixel;
    Eigen::Vector3d information;  // 0 for what was not measured
    double max_chi2;
    bool is_backward, is_active;
  };
  struct Projected;

  void Add(const Eigen::Vector3d& point, const PixelMeasurement& m, bool is_backward);
  Projected Project(const Observation& o, const State& state) const;
  double Loss(const Observation& o, const Projected& p, double* weight) const;
  void Accumulate(const Observation& o, const State& state, PoseNormalEquations* sums) const;
  PoseNormalEquations Sum(const State& state) const;

  StereoIntrinsics intrinsics_;
  Rigid3d prior_;
  Eigen::Matrix3d prior_rotation_;
  std::vector<Observation> observations_;
  bool is_robust_ = true;
  double noise_variance_ = 1;  // as a multiple of what observations were given
};

}  // namespace orbslam
