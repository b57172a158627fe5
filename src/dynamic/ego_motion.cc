// SPDX-License-Identifier: GPL-3.0-or-later
#include "ego_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

using Matrix6f = Eigen::Matrix<float, 6, 6>;
using Vector6f = Eigen::Matrix<float, 6, 1>;

struct Motion {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
};

Motion ToMotion(const Rigid3d& pose) {
  return {pose.RotationMatrix().cast<float>(), pose.translation.cast<float>()};
}

/// Squared reprojection error, px^2; huge behind the camera.
float SquaredError(const GridCamera& camera, const Motion& motion, const CornerMatch& match) {
  const Eigen::Vector3f q = motion.rotation * match.x_previous + motion.translation;
  if (q.z() < 0.05f) return 1e9f;
  const float du = camera.fx * q.x() / q.z() + camera.cx - match.pixel.x();
  const float dv = camera.fy * q.y() / q.z() + camera.cy - match.pixel.y();
  return du * du + dv * dv;
}

/// Of a pixel, by the pose: rotation, then translation, on its left. x, y: of the point, at z = 1.
Eigen::Matrix<float, 2, 6> Jacobian(const GridCamera& camera, float x, float y, float inverse_z) {
  Eigen::Matrix<float, 2, 6> jacobian;
  jacobian << -camera.fx * x * y, camera.fx * (1 + x * x), -camera.fx * y, camera.fx * inverse_z, 0,
      -camera.fx * x * inverse_z, -camera.fy * (1 + y * y), camera.fy * x * y, camera.fy * x, 0,
      camera.fy * inverse_z, -camera.fy * y * inverse_z;
  return jacobian;
}

/// The small motion, on its left, that leads from b to a.
Eigen::Matrix<double, 6, 1> Difference(const Rigid3d& a, const Rigid3d& b) {
  const Rigid3d a_from_b = a * Inverse(b);
  Eigen::Matrix<double, 6, 1> difference;
  difference << So3Log(a_from_b.rotation), a_from_b.translation;
  return difference;
}

/// One Gauss-Newton step over the given matches, each weighted by Tukey's biweight of scale (px); 0: all
/// alike.
Rigid3d Improve(const GridCamera& camera, const std::vector<CornerMatch>& matches,
                const std::vector<int>& used, const Rigid3d& pose, float scale_px,
                const PosePrior* prior = nullptr, Matrix6f* information = nullptr) {
  const Motion motion = ToMotion(pose);
  Matrix6f hessian = Matrix6f::Identity() * 1e-3f;
  Vector6f gradient = Vector6f::Zero();
  if (prior != nullptr) {
    hessian = prior->information.cast<float>();
    gradient = hessian * Difference(pose, prior->current_from_previous).cast<float>();
  }
  for (const int index : used) {
    const CornerMatch& match = matches[index];
    const Eigen::Vector3f q = motion.rotation * match.x_previous + motion.translation;
    if (q.z() < 0.05f) continue;
    const float iz = 1 / q.z(), x = q.x() * iz, y = q.y() * iz;
    const Eigen::Vector2f error(camera.fx * x + camera.cx - match.pixel.x(),
                                camera.fy * y + camera.cy - match.pixel.y());
    float weight = 1;
    if (scale_px > 0) {
      const float share2 = error.squaredNorm() / (scale_px * scale_px);
      if (share2 >= 1) continue;
      weight = (1 - share2) * (1 - share2);
    }
    const Eigen::Matrix<float, 2, 6> jacobian = Jacobian(camera, x, y, iz);
    hessian.noalias() += weight * jacobian.transpose() * jacobian;
    gradient.noalias() += weight * jacobian.transpose() * error;
  }
  if (information != nullptr) *information = hessian;
  const Eigen::Matrix<double, 6, 1> step = (-hessian.ldlt().solve(gradient)).cast<double>();
  if (!step.allFinite()) return pose;
  return Rigid3d{So3Exp(step.head<3>()), step.tail<3>()} * pose;
}

/// Truncated sum of squared errors (MSAC, Torr and Zisserman 2000), or some sum above limit.
float Cost(const GridCamera& camera, const std::vector<CornerMatch>& matches, const Rigid3d& pose,
           float inlier_px, float limit = std::numeric_limits<float>::infinity()) {
  const Motion motion = ToMotion(pose);
  float sum = 0;
  for (const CornerMatch& match : matches) {
    sum += std::min(SquaredError(camera, motion, match), inlier_px * inlier_px);
    if (sum > limit) break;
  }
  return sum;
}

int NumInliers(const GridCamera& camera, const std::vector<CornerMatch>& matches, const Rigid3d& pose,
               float inlier_px) {
  const Motion motion = ToMotion(pose);
  return static_cast<int>(std::ranges::count_if(matches, [&](const CornerMatch& match) {
    return SquaredError(camera, motion, match) < inlier_px * inlier_px;
  }));
}

/// After which three inliers were drawn together at least once, but for that chance (Fischler and Bolles,
/// CACM 1981).
double NumDraws(double inlier_share, double max_missed) {
  const double all_inliers = std::clamp(inlier_share * inlier_share * inlier_share, 1e-9, 1 - 1e-9);
  return std::log(max_missed) / std::log(1 - all_inliers);
}

Rigid3d BestHypothesis(const GridCamera& camera, const std::vector<CornerMatch>& matches,
                       const std::vector<Rigid3d>& candidates, const PoseFromCornersOptions& options,
                       Rng* rng) {
  Rigid3d best = candidates.front();
  float best_cost = Cost(camera, matches, best, options.inlier_px);
  const auto consider = [&](const Rigid3d& pose) {
    const float cost = Cost(camera, matches, pose, options.inlier_px, best_cost);
    const bool is_better = cost < best_cost;
    if (is_better) best = pose, best_cost = cost;
    return is_better;
  };
  const auto num_draws = [&](const Rigid3d& pose) {
    const double share =
        NumInliers(camera, matches, pose, options.inlier_px) / static_cast<double>(matches.size());
    return NumDraws(share, options.max_missed);
  };
  for (size_t i = 1; i < candidates.size(); ++i) consider(candidates[i]);
  const Rigid3d start = best;
  const auto count = static_cast<uint32_t>(matches.size());
  std::vector<int> triple(3);
  double enough = num_draws(best);
  for (int draw = 0; draw < options.num_draws && draw < enough; ++draw) {
    for (int& index : triple) index = static_cast<int>(rng->Below(count));
    if (triple[0] == triple[1] || triple[0] == triple[2] || triple[1] == triple[2]) continue;
    Rigid3d pose = start;
    for (int i = 0; i < 3; ++i) pose = Improve(camera, matches, triple, pose, 0);
    if (consider(pose)) enough = num_draws(best);
  }
  return best;
}

}  // namespace

Eigen::Vector2d ErrorPx(const GridCamera& camera, const Rigid3d& pose, const CornerMatch& match) {
  const Eigen::Vector3d q = pose * match.x_previous.cast<double>();
  const double z = std::max(q.z(), 0.05);
  return {camera.fx * q.x() / z + camera.cx - match.pixel.x(),
          camera.fy * q.y() / z + camera.cy - match.pixel.y()};
}

Eigen::Matrix<double, 2, 6> PixelFromMotion(const GridCamera& camera, const Rigid3d& pose,
                                            const CornerMatch& match) {
  const Eigen::Vector3f q = (pose * match.x_previous.cast<double>()).cast<float>();
  const float inverse_z = 1 / std::max(q.z(), 0.05f);
  return Jacobian(camera, q.x() * inverse_z, q.y() * inverse_z, inverse_z).cast<double>();
}

PoseFromCorners EstimatePose(const GridCamera& camera, const std::vector<CornerMatch>& matches,
                             const std::vector<Rigid3d>& candidates, const PoseFromCornersOptions& options,
                             Rng* rng, const PosePrior* prior) {
  PoseFromCorners result;
  result.current_from_previous = candidates.front();
  if (static_cast<int>(matches.size()) < options.min_inliers) return result;
  Rigid3d pose = BestHypothesis(camera, matches, candidates, options, rng);
  std::vector<int> all(matches.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  std::optional<PosePrior> scaled;  // like information: of a flow with an error of 1 px
  if (prior != nullptr)
    scaled = {prior->current_from_previous, prior->information * options.sigma_px * options.sigma_px};
  Matrix6f information;
  for (int i = 0; i < 5; ++i)
    pose = Improve(camera, matches, all, pose, 1.5f * options.inlier_px, scaled ? &*scaled : nullptr,
                   &information);
  result.information = information.cast<double>() / (options.sigma_px * options.sigma_px);
  result.num_inliers = NumInliers(camera, matches, pose, options.inlier_px);
  result.ok = result.num_inliers >= options.min_inliers;
  result.current_from_previous = pose;
  return result;
}

}  // namespace orbslam
