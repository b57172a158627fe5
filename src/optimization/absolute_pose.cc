// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/absolute_pose.h"

#include <opencv2/calib3d.hpp>

#include "optimization/ransac.h"
#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

// Up to four poses from three points; pixels are turned into rays first, so that the camera matrix is the
// identity.
std::vector<Rigid3d> SolveSample(const StereoIntrinsics& k, const std::vector<PoseObservation>& observations,
                                 const std::array<int, 3>& sample) {
  std::array<cv::Point3d, 3> points;
  std::array<cv::Point2d, 3> rays;
  for (int i = 0; i < 3; ++i) {
    const PoseObservation& o = observations[sample[i]];
    points[i] = {o.point_world.x(), o.point_world.y(), o.point_world.z()};
    rays[i] = {(o.pixel.x() - k.cx) / k.fx, (o.pixel.y() - k.cy) / k.fy};
  }
  if (!IsProperTriangle(observations[sample[0]].point_world, observations[sample[1]].point_world,
                        observations[sample[2]].point_world)) {
    return {};
  }
  std::vector<cv::Vec3d> rotations, translations;
  cv::solveP3P(points, rays, cv::Matx33d::eye(), cv::noArray(), rotations, translations, cv::SOLVEPNP_AP3P);
  std::vector<Rigid3d> poses;
  for (size_t i = 0; i < rotations.size(); ++i) {
    const Eigen::Vector3d w(rotations[i].val), t(translations[i].val);
    if (w.allFinite() && t.allFinite()) poses.push_back({So3Exp(w), t});
  }
  return poses;
}

int CountInliers(const StereoIntrinsics& intrinsics, const std::vector<PoseObservation>& observations,
                 double max_chi2, const Rigid3d& camera_from_world, std::vector<char>* is_inlier) {
  const Eigen::Matrix3d rotation = camera_from_world.RotationMatrix();
  int count = 0;
  for (size_t i = 0; i < observations.size(); ++i) {
    const PoseObservation& o = observations[i];
    const Eigen::Vector3d x = rotation * o.point_world + camera_from_world.translation;
    (*is_inlier)[i] =
        x.z() > 0 &&
        o.inverse_variance * (intrinsics.Project(x) - o.pixel).head<2>().squaredNorm() <= max_chi2;
    count += (*is_inlier)[i];
  }
  return count;
}

Rigid3d OptimizeInliers(const StereoIntrinsics& intrinsics, const std::vector<PoseObservation>& observations,
                        const Consensus& consensus) {
  PoseProblem problem{intrinsics, consensus.pose, {}};
  for (size_t i = 0; i < observations.size(); ++i) {
    if (consensus.is_inlier[i]) problem.observations.push_back(observations[i]);
  }
  return OptimizePose(problem).camera_from_world;
}

}  // namespace

std::optional<PoseResult> EstimateAbsolutePose(const StereoIntrinsics& intrinsics,
                                               const std::vector<PoseObservation>& observations,
                                               const AbsolutePoseOptions& options, Rng* rng) {
  const auto fit = [&](const std::array<int, 3>& sample) {
    return SolveSample(intrinsics, observations, sample);
  };
  const auto count = [&](const Rigid3d& camera_from_world, std::vector<char>* is_inlier) {
    return CountInliers(intrinsics, observations, options.max_chi2, camera_from_world, is_inlier);
  };
  const int n = static_cast<int>(observations.size());
  Consensus best = FindConsensus(n, options.max_samples, options.confidence, rng, fit, count);
  // Three points always agree with their own pose: only a fourth says anything.
  if (best.num_inliers < std::max(options.min_inliers, 4)) return std::nullopt;
  Consensus joint{OptimizeInliers(intrinsics, observations, best), std::vector<char>(n), 0};
  joint.num_inliers = count(joint.pose, &joint.is_inlier);
  if (joint.num_inliers >= best.num_inliers) best = joint;
  return PoseResult{best.pose, best.is_inlier, best.num_inliers};
}

}  // namespace orbslam
