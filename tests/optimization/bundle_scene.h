// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "optimization/scene.h"
#include "orbslam/optimization/bundle_adjuster.h"

namespace orbslam::test {

struct BundleSceneOptions {
  int num_fixed_poses = 2, num_free_poses = 6;
  int num_points = 300;
  int views_per_point = 5;  // by neighbouring cameras
  double noise_px = 0.5;
  double outlier_share = 0;
  double pose_error_rad = 0.005, pose_error_m = 0.01, point_error_m = 0.02;
};

struct BundleScene {
  BundleProblem truth, problem;      // problem: measured, and moved away from the truth
  std::vector<char> is_true_inlier;  // one an observation
};

/// Cameras on a track along x that look along z, fixed ones first; each point is seen by a run of neighbours.
inline BundleScene MakeBundleScene(const BundleSceneOptions& options, Rng* rng) {
  BundleScene scene;
  BundleProblem& truth = scene.truth;
  truth.intrinsics = Kinect();
  const int num_poses = options.num_fixed_poses + options.num_free_poses;
  for (int i = 0; i < num_poses; ++i) {
    const Rigid3d world_from_camera{So3Exp(RandomVector(rng, 0.05)), {0.1 * i, 0.02 * rng->Gaussian(), 0}};
    truth.poses.push_back({Inverse(world_from_camera), i < options.num_fixed_poses});
  }
  const int views = std::min(options.views_per_point, num_poses);
  for (int p = 0; p < options.num_points; ++p) {
    const int first = static_cast<int>(rng->Below(num_poses - views + 1)), middle = first + views / 2;
    const Eigen::Vector3d x = RandomVisiblePoint(truth.intrinsics, rng);
    truth.points.push_back(Inverse(truth.poses[middle].camera_from_world) * x);
    for (int i = first; i < first + views; ++i) {
      const Eigen::Vector3d seen = truth.poses[i].camera_from_world * truth.points.back();
      if (seen.z() < 0.3) continue;
      const bool is_outlier = rng->Uniform() < options.outlier_share;
      Eigen::Vector3d pixel = Measure(truth.intrinsics, seen, options.noise_px, p % 3 != 0, rng);
      if (is_outlier) pixel.y() += rng->Uniform(20, 100);
      const double variance = std::max(options.noise_px * options.noise_px, 1e-2);
      truth.observations.push_back({i, p, pixel, 1 / variance});
      scene.is_true_inlier.push_back(!is_outlier);
    }
  }
  scene.problem = truth;
  for (BundlePose& pose : scene.problem.poses) {
    if (pose.is_fixed) continue;
    pose.camera_from_world =
        RandomMotion(rng, options.pose_error_rad, options.pose_error_m) * pose.camera_from_world;
  }
  for (Eigen::Vector3d& point : scene.problem.points) point += RandomVector(rng, options.point_error_m);
  return scene;
}

}  // namespace orbslam::test
