// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/far_pose.h"

#include <Eigen/LU>
#include <algorithm>

#include "optimization/noise_variance.h"
#include "orbslam/geometry/depth_split.h"
#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

constexpr int kMinNear = 5;           // fewer may be wrong matches
constexpr int kMinFar = 50;           // what ORB-SLAM2 asks of a pose that nothing else confirms
constexpr double kMinFarShare = 0.7;  // must agree on one pose
constexpr double kMinSigmas = 4;
constexpr double kLeastNoiseVariance = 0.02;  // of what was given: 0.14 px, of sharp corners at their best

double DepthM(const Rigid3d& camera_from_world, const PoseObservation& o) {
  return (camera_from_world * o.point_world).z();
}

/// 0: they are not of two depths.
double SplitOfInliersM(const PoseProblem& problem, const PoseResult& all) {
  std::vector<double> depths_m;
  for (size_t i = 0; i < problem.observations.size(); ++i) {
    if (all.is_inlier[i]) depths_m.push_back(DepthM(all.camera_from_world, problem.observations[i]));
  }
  return SplitDepthM(depths_m);
}

/// Of (u, v), px, by a small motion (w, t) of the camera's frame.
Eigen::Matrix<double, 2, 6> PixelFromMotion(const StereoIntrinsics& intrinsics, const Eigen::Vector3d& x) {
  const double a = intrinsics.fx / x.z(), c = intrinsics.fy / x.z();
  Eigen::Matrix<double, 2, 3> pixel_from_point;
  pixel_from_point << a, 0, -a * x.x() / x.z(), 0, c, -c * x.y() / x.z();
  Eigen::Matrix<double, 2, 6> jacobian;
  jacobian << -pixel_from_point * CrossMatrix(x), pixel_from_point;
  return jacobian;
}

/// A pose that may contradict observations it was not found by.
class Judge {
 public:
  Judge(const PoseProblem& problem, const PoseResult& result)
      : intrinsics_(problem.intrinsics), pose_(result.camera_from_world) {
    NoiseVariance noise;
    for (size_t i = 0; i < problem.observations.size(); ++i) {
      const PoseObservation& o = problem.observations[i];
      if (result.is_inlier[i]) noise.Add(o.inverse_variance * ErrorPx(o).squaredNorm(), 2);
    }
    noise_variance_ = noise.Estimate(kLeastNoiseVariance);
    covariance_ = noise_variance_ * result.information.inverse();
  }

  bool Contradicts(const PoseObservation& o) const {
    const Eigen::Matrix<double, 2, 6> jacobian = PixelFromMotion(intrinsics_, pose_ * o.point_world);
    const Eigen::Matrix2d covariance = jacobian * covariance_ * jacobian.transpose() +
                                       noise_variance_ / o.inverse_variance * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d error = ErrorPx(o);
    return error.dot(covariance.inverse() * error) > kMinSigmas * kMinSigmas;
  }

 private:
  Eigen::Vector2d ErrorPx(const PoseObservation& o) const {
    return intrinsics_.ReprojectionError(pose_ * o.point_world, o.pixel).head<2>();
  }

  const StereoIntrinsics& intrinsics_;
  const Rigid3d pose_;
  double noise_variance_ = 1;
  Matrix6d covariance_;
};

/// Over those alone that are kept; the others are no inliers.
PoseResult OptimizeKept(const PoseProblem& problem, const Rigid3d& prior, const std::vector<char>& is_kept) {
  PoseProblem kept{problem.intrinsics, prior, {}};
  std::vector<size_t> index;
  for (size_t i = 0; i < is_kept.size(); ++i) {
    if (is_kept[i]) kept.observations.push_back(problem.observations[i]), index.push_back(i);
  }
  PoseResult result = OptimizePose(kept);
  std::vector<char> is_inlier(is_kept.size(), 0);
  for (size_t k = 0; k < index.size(); ++k) is_inlier[index[k]] = result.is_inlier[k];
  result.is_inlier = std::move(is_inlier);
  return result;
}

}  // namespace

std::optional<FarPose> FindContradictingFarPose(const PoseProblem& problem, const PoseResult& all) {
  const double split_m = SplitOfInliersM(problem, all);
  PoseProblem far{problem.intrinsics, all.camera_from_world, {}};
  std::vector<size_t> near;
  for (size_t i = 0; i < problem.observations.size(); ++i) {
    if (DepthM(all.camera_from_world, problem.observations[i]) >= split_m)
      far.observations.push_back(problem.observations[i]);
    else if (all.is_inlier[i])
      near.push_back(i);
  }
  if (std::ssize(near) < kMinNear || std::ssize(far.observations) < kMinFar) return {};
  const PoseResult by_far = OptimizePose(far);
  const auto num_far = static_cast<double>(far.observations.size());
  if (by_far.num_inliers <
      std::max({kMinFarShare * num_far, static_cast<double>(near.size()), 1.0 * kMinFar}))
    return {};

  const Judge judge(far, by_far);
  std::vector<char> is_kept(problem.observations.size(), 1);
  for (const size_t i : near) is_kept[i] = !judge.Contradicts(problem.observations[i]);
  if (2 * std::ranges::count(is_kept, 0) < std::ssize(near)) return {};
  return FarPose{OptimizeKept(problem, by_far.camera_from_world, is_kept), split_m};
}

}  // namespace orbslam
