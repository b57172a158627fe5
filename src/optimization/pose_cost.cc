// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimization/pose_cost.h"

#include <cmath>
#include <limits>

#include "optimization/noise_variance.h"
#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

// What an active observation costs while it is behind the camera or too near (NearestUsableM): more than any
// that a step would trade for it.
constexpr double kBehindLoss = 1e3;

}  // namespace

struct PoseCost::Projected {
  Eigen::Vector3d rotated;   // y of PoseNormalEquations
  Eigen::Vector3d x;         // in the camera that sees it
  Eigen::Vector3d residual;  // px
  double inverse_depth;
  double chi2;
  bool is_in_front;
};

PoseCost::PoseCost(const StereoIntrinsics& intrinsics, const Rigid3d& b_from_a)
    : intrinsics_(intrinsics), prior_(b_from_a), prior_rotation_(b_from_a.RotationMatrix()) {}

void PoseCost::AddForward(const Eigen::Vector3d& x_a, const PixelMeasurement& seen_in_b) {
  Add(prior_rotation_ * x_a + prior_.translation, seen_in_b, false);
}

void PoseCost::AddBackward(const Eigen::Vector3d& x_b, const PixelMeasurement& seen_in_a) {
  Add(x_b, seen_in_a, true);
}

void PoseCost::Add(const Eigen::Vector3d& point, const PixelMeasurement& m, bool is_backward) {
  const double right_information = m.pixel.z() < 0 ? 0.0 : m.inverse_variance;
  observations_.push_back({point,
                           m.pixel,
                           {m.inverse_variance, m.inverse_variance, right_information},
                           m.max_chi2,
                           is_backward,
                           true});
}

PoseCost::State PoseCost::At(const Vector6d& parameters) const {
  const Eigen::Matrix3d rotation = So3Exp(parameters.head<3>()).toRotationMatrix();
  return {rotation, parameters.tail<3>(), (rotation * prior_rotation_).transpose()};
}

Rigid3d PoseCost::PoseAt(const Vector6d& parameters) const {
  return Rigid3d{So3Exp(parameters.head<3>()), parameters.tail<3>()} * prior_;
}

inline PoseCost::Projected PoseCost::Project(const Observation& o, const State& state) const {
  Projected p;
  if (o.is_backward) {
    p.rotated = o.point - state.translation;
    p.x = state.a_rotation_b * p.rotated - prior_rotation_.transpose() * prior_.translation;
  } else {
    p.rotated = state.rotation * o.point;
    p.x = p.rotated + state.translation;
  }
  p.is_in_front = p.x.z() > NearestUsableM(o.pixel);
  p.inverse_depth = 1.0 / p.x.z();
  p.residual = intrinsics_.ReprojectionError(p.x, o.pixel);
  p.chi2 = p.residual.dot(o.information.cwiseProduct(p.residual));
  return p;
}

double PoseCost::Chi2(int i, const State& state) const {
  const Projected p = Project(observations_[i], state);
  return p.is_in_front && std::isfinite(p.chi2) ? p.chi2 : std::numeric_limits<double>::infinity();
}

std::vector<double> PoseCost::Chi2(const State& state) const {
  std::vector<double> chi2;
  chi2.reserve(observations_.size());
  for (int i = 0; i < NumObservations(); ++i) chi2.push_back(Chi2(i, state));
  return chi2;
}

void PoseCost::AdaptGates(const std::vector<double>& chi2) {
  NoiseVariance noise;
  for (size_t i = 0; i < chi2.size(); ++i) noise.Add(chi2[i], observations_[i].information.z() > 0 ? 3 : 2);
  noise_variance_ = noise.Estimate();
}

// Huber's rho of the squared error; weight is its derivative.
inline double PoseCost::Loss(const Observation& o, const Projected& p, double* weight) const {
  const double max_chi2 = noise_variance_ * o.max_chi2;
  if (!is_robust_ || p.chi2 <= max_chi2) {
    *weight = 1;
    return p.chi2;
  }
  *weight = std::sqrt(max_chi2 / p.chi2);
  return 2 * std::sqrt(max_chi2 * p.chi2) - max_chi2;
}

inline void PoseCost::Accumulate(const Observation& o, const State& state, PoseNormalEquations* sums) const {
  const Projected p = Project(o, state);
  if (!p.is_in_front) {
    sums->cost += kBehindLoss;
    return;
  }
  double weight;
  sums->cost += Loss(o, p, &weight);
  const Eigen::Vector3d w = weight * o.information;
  // Rows of the projection's Jacobian: (a, 0, b), (0, c, d), (0, 0, e).
  const double a = intrinsics_.fx * p.inverse_depth, b = -a * p.x.x() * p.inverse_depth;
  const double c = intrinsics_.fy * p.inverse_depth, d = -c * p.x.y() * p.inverse_depth;
  const double e = -intrinsics_.bf * p.inverse_depth * p.inverse_depth;
  const double xz = w[0] * a * b, yz = w[1] * c * d;
  Eigen::Matrix3d jtj;
  jtj << w[0] * a * a, 0, xz,  //
      0, w[1] * c * c, yz,     //
      xz, yz, w[0] * b * b + w[1] * d * d + w[2] * e * e;
  const Eigen::Vector3d wr = w.cwiseProduct(p.residual);
  const Eigen::Vector3d jtr(a * wr[0], c * wr[1], b * wr[0] + d * wr[1] + e * wr[2]);
  if (o.is_backward) {
    // d x_a = -(a_rotation_b) (d_w x y + d_t): the same form after turning into frame b.
    sums->Add(p.rotated, state.a_rotation_b.transpose() * jtj * state.a_rotation_b,
              -(state.a_rotation_b.transpose() * jtr));
  } else {
    sums->Add(p.rotated, jtj, jtr);
  }
}

PoseNormalEquations PoseCost::Sum(const State& state) const {
  PoseNormalEquations sums;
  for (const Observation& o : observations_) {
    if (o.is_active) Accumulate(o, state, &sums);
  }
  return sums;
}

Matrix6d PoseCost::Information(const State& state) const { return Sum(state).Hessian(); }

bool PoseCost::operator()(const double* parameters, double* residuals, double* jacobian) const {
  const Vector6d x = Eigen::Map<const Vector6d>(parameters);
  const State state = At(x);
  if (jacobian != nullptr) {
    Sum(state).WriteCompressed(So3LeftJacobian(x.head<3>()), residuals, jacobian);
    return true;
  }
  double cost = 0, weight;
  for (const Observation& o : observations_) {
    if (!o.is_active) continue;
    const Projected p = Project(o, state);
    cost += p.is_in_front ? Loss(o, p, &weight) : kBehindLoss;
  }
  Eigen::Map<Eigen::Matrix<double, 7, 1>> r(residuals);
  r.setZero();
  r[6] = std::sqrt(cost);
  return true;
}

}  // namespace orbslam
