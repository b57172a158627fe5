// SPDX-License-Identifier: GPL-3.0-or-later
#include "icp.h"

#include <Eigen/Cholesky>

#include "icp_pairs.h"
#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

using Matrix6f = Eigen::Matrix<float, 6, 6>;
using Vector6f = Eigen::Matrix<float, 6, 1>;

/// One Gauss-Newton step with the prior; the pose's perturbation.
Vector6f Step(const PairSums& sums, float weight, const Rigid3d& prior_from_source,
              const Matrix6f& prior_information) {
  Matrix6f hessian;
  Vector6f gradient;
  for (int a = 0; a < 6; ++a) {
    gradient[a] = weight * sums(a, 6);
    for (int b = a; b < 6; ++b) hessian(a, b) = hessian(b, a) = weight * sums(a, b);
  }
  Vector6f from_prior;
  from_prior << So3Log(prior_from_source.rotation).cast<float>(), prior_from_source.translation.cast<float>();
  hessian += prior_information;
  gradient += prior_information * from_prior;
  return -hessian.ldlt().solve(gradient);
}

}  // namespace

Eigen::Matrix<double, 6, 6> IsotropicInformation(double sigma_rotation_rad, double sigma_translation_m) {
  Eigen::Matrix<double, 6, 1> sigma;
  sigma << Eigen::Vector3d::Constant(sigma_rotation_rad), Eigen::Vector3d::Constant(sigma_translation_m);
  return sigma.array().square().inverse().matrix().asDiagonal();
}

IcpResult AlignDepth(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
                     std::span<const IcpTarget> targets, const Rigid3d& base_from_source_prior,
                     const Eigen::Matrix<double, 6, 6>& prior_information, const IcpOptions& options) {
  IcpResult result;
  result.base_from_source = base_from_source_prior;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    PairSums sums;
    const int stride = iteration < 2 && options.iterations > 3 ? 2 * options.stride : options.stride;
    for (const IcpTarget& target : targets)
      AddPairs(camera, source, ignored_source, target, target.target_from_base * result.base_from_source,
               options, stride, &sums);
    result.num_pairs = sums.num_pairs, result.num_fitting = sums.num_fitting;
    const Rigid3d prior_from_source = Inverse(base_from_source_prior) * result.base_from_source;
    const Eigen::Matrix<double, 6, 1> step = Step(sums, static_cast<float>(options.independent_share),
                                                  prior_from_source, prior_information.cast<float>())
                                                 .cast<double>();
    result.base_from_source = result.base_from_source * Rigid3d{So3Exp(step.head<3>()), step.tail<3>()};
    if (stride == options.stride && step.head<3>().norm() < 1e-5 && step.tail<3>().norm() < 2e-5) break;
  }
  return result;
}

}  // namespace orbslam
