// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/pose_optimizer.h"

#include <gtest/gtest.h>

#include <limits>

#include "optimization/scene.h"

namespace orbslam {
namespace {

struct Truth {
  Rigid3d camera_from_world;
  std::vector<char> is_inlier;
};

// Every third keypoint has no depth; the prior is a few degrees and centimetres off.
PoseProblem RandomProblem(int n, double noise_px, double outlier_share, Rng* rng, Truth* truth) {
  PoseProblem problem{test::Kinect(), {}, {}};
  truth->camera_from_world = test::RandomMotion(rng, 1, 1);
  const Rigid3d world_from_camera = Inverse(truth->camera_from_world);
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d x = test::RandomVisiblePoint(problem.intrinsics, rng);
    const bool is_outlier = rng->Uniform() < outlier_share;
    const Eigen::Vector3d seen = is_outlier ? test::RandomVisiblePoint(problem.intrinsics, rng) : x;
    problem.observations.push_back({world_from_camera * x,
                                    test::Measure(problem.intrinsics, seen, noise_px, i % 3 != 0, rng),
                                    noise_px > 0 ? 1 / (noise_px * noise_px) : 1});
    truth->is_inlier.push_back(!is_outlier);
  }
  problem.camera_from_world = test::RandomMotion(rng, 0.02, 0.03) * truth->camera_from_world;
  return problem;
}

double AngleError(const Rigid3d& a, const Rigid3d& b) { return AngularDistance(a.rotation, b.rotation); }
double DistanceError(const Rigid3d& a, const Rigid3d& b) {
  return (Inverse(a).translation - Inverse(b).translation).norm();
}

TEST(PoseOptimizer, FindsTheExactPoseWithoutNoise) {
  Rng rng(1);
  for (int trial = 0; trial < 50; ++trial) {
    Truth truth;
    const PoseProblem problem = RandomProblem(10 + trial, 0, 0, &rng, &truth);
    const PoseResult result = OptimizePose(problem);
    EXPECT_LT(AngleError(result.camera_from_world, truth.camera_from_world), 1e-8) << trial;
    EXPECT_LT(DistanceError(result.camera_from_world, truth.camera_from_world), 1e-8) << trial;
    EXPECT_EQ(result.num_inliers, 10 + trial);
  }
}

TEST(PoseOptimizer, SurvivesFortyPercentOutliers) {
  Rng rng(2);
  for (int trial = 0; trial < 50; ++trial) {
    Truth truth;
    const PoseProblem problem = RandomProblem(300, 1.0, 0.4, &rng, &truth);
    const PoseResult result = OptimizePose(problem);
    // Noise of one px in 180 pixels alone would turn the camera by 1e-4; translation is confused with
    // rotation.
    EXPECT_LT(AngleError(result.camera_from_world, truth.camera_from_world), 2e-3) << trial;
    EXPECT_LT(DistanceError(result.camera_from_world, truth.camera_from_world), 6e-3) << trial;
    int kept = 0, true_inliers = 0, wrong = 0;
    for (size_t i = 0; i < truth.is_inlier.size(); ++i) {
      true_inliers += truth.is_inlier[i];
      kept += truth.is_inlier[i] && result.is_inlier[i];
      wrong += !truth.is_inlier[i] && result.is_inlier[i];
    }
    EXPECT_GT(kept, 0.9 * true_inliers) << trial;
    EXPECT_LE(wrong, 3) << trial;
    EXPECT_EQ(result.num_inliers, kept + wrong);
  }
}

/// The pixels are said to be exact to 1 px, but are to a third; two are then no noise.
TEST(PoseOptimizer, WhoSwaysByTwoPixelsIsNoPartOfASharpFrame) {
  constexpr int kAll = 210, kSwaying = 60;
  Rng rng(8);
  double with_m = 0, without_m = 0;
  int num_swaying_inliers = 0;
  for (int trial = 0; trial < 50; ++trial) {
    Truth truth;
    PoseProblem problem = RandomProblem(kAll, 0.3, 0, &rng, &truth);
    for (PoseObservation& o : problem.observations) o.inverse_variance = 1;
    PoseProblem alone = problem;
    alone.observations.erase(alone.observations.begin(), alone.observations.begin() + kSwaying);
    for (int i = 0; i < kSwaying; ++i) {
      Eigen::Vector3d& pixel = problem.observations[i].pixel;
      pixel.x() += 2;
      if (pixel.z() >= 0) pixel.z() += 2;
    }
    const PoseResult result = OptimizePose(problem);
    with_m += DistanceError(result.camera_from_world, truth.camera_from_world);
    without_m += DistanceError(OptimizePose(alone).camera_from_world, truth.camera_from_world);
    for (int i = 0; i < kSwaying; ++i) num_swaying_inliers += result.is_inlier[i];
  }
  EXPECT_LT(with_m, 1.2 * without_m);
  EXPECT_LT(num_swaying_inliers, 0.02 * 50 * kSwaying);
}

TEST(PoseOptimizer, RepeatsBitForBit) {
  Rng rng(3);
  Truth truth;
  const PoseProblem problem = RandomProblem(200, 1, 0.2, &rng, &truth);
  const PoseResult a = OptimizePose(problem), b = OptimizePose(problem);
  EXPECT_EQ(a.camera_from_world.rotation.coeffs(), b.camera_from_world.rotation.coeffs());
  EXPECT_EQ(a.camera_from_world.translation, b.camera_from_world.translation);
  EXPECT_EQ(a.is_inlier, b.is_inlier);
}

// The error's square in units of what is said of it has as mean the number of its degrees of freedom.
TEST(PoseOptimizer, SaysHowWellThePoseIsKnown) {
  Rng rng(7);
  constexpr int kTrials = 200;
  double sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Truth truth;
    const PoseResult result = OptimizePose(RandomProblem(30 + trial, 0.5 + 0.01 * trial, 0, &rng, &truth));
    const Rigid3d error = result.camera_from_world * Inverse(truth.camera_from_world);
    Vector6d motion;
    motion << So3Log(error.rotation), error.translation;
    sum += motion.dot(result.information * motion);
  }
  EXPECT_NEAR(sum / kTrials, 6, 1);
}

TEST(PoseOptimizer, TooFewObservationsLeaveThePrior) {
  Rng rng(4);
  for (int n = 0; n < 3; ++n) {
    Truth truth;
    const PoseProblem problem = RandomProblem(n, 0, 0, &rng, &truth);
    const PoseResult result = OptimizePose(problem);
    EXPECT_EQ(result.num_inliers, 0);
    EXPECT_EQ(result.information, Matrix6d::Zero());
    EXPECT_EQ(result.camera_from_world.translation, problem.camera_from_world.translation);
  }
}

TEST(PoseOptimizer, UnusableObservationsAreOutliers) {
  Rng rng(5);
  Truth truth;
  PoseProblem problem = RandomProblem(100, 0, 0, &rng, &truth);
  problem.observations[0].point_world = Inverse(truth.camera_from_world) * Eigen::Vector3d(0, 0, -2);
  problem.observations[1].point_world.x() = std::numeric_limits<double>::quiet_NaN();
  problem.observations[2].pixel.y() = std::numeric_limits<double>::infinity();
  const PoseResult result = OptimizePose(problem);
  EXPECT_EQ(result.num_inliers, 97);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(result.is_inlier[i]);
  EXPECT_LT(DistanceError(result.camera_from_world, truth.camera_from_world), 1e-8);
}

/// A wrong match of a keypoint without depth: the triangulated point lies before the lens, and fits the pose
/// it asks for better the nearer it comes.
TEST(PoseOptimizer, AWrongPointBeforeTheLensDoesNotPullTheCamera) {
  Rng rng(9);
  double with_m = 0, without_m = 0;
  for (int trial = 0; trial < 50; ++trial) {
    Truth truth;
    PoseProblem problem = RandomProblem(300, 0.5, 0, &rng, &truth);
    without_m += DistanceError(OptimizePose(problem).camera_from_world, truth.camera_from_world);
    const Eigen::Vector3d at_lens(rng.Uniform(-0.01, 0.01), rng.Uniform(-0.01, 0.01), rng.Uniform(0.02, 0.3));
    problem.observations.push_back({Inverse(truth.camera_from_world) * at_lens, {400, 200, -1}, 1});
    const PoseResult result = OptimizePose(problem);
    with_m += DistanceError(result.camera_from_world, truth.camera_from_world);
    EXPECT_FALSE(result.is_inlier.back()) << trial;
  }
  EXPECT_LT(with_m, 1.01 * without_m);
}

TEST(PoseOptimizer, WhatHasDepthMayBeNear) {
  Rng rng(10);
  Truth truth;
  PoseProblem problem = RandomProblem(100, 0, 0, &rng, &truth);
  for (const bool has_depth : {true, false}) {
    const Eigen::Vector3d x(0.1, 0.05, 0.3);
    problem.observations.push_back(
        {Inverse(truth.camera_from_world) * x, test::Measure(problem.intrinsics, x, 0, has_depth, &rng), 1});
  }
  const PoseResult result = OptimizePose(problem);
  EXPECT_TRUE(result.is_inlier[100]);
  EXPECT_FALSE(result.is_inlier[101]);
}

TEST(PoseOptimizer, DegenerateGeometryStaysFinite) {
  Rng rng(6);
  Truth truth;
  PoseProblem problem = RandomProblem(20, 0, 0, &rng, &truth);
  for (PoseObservation& o : problem.observations) o = problem.observations[1];
  const PoseResult result = OptimizePose(problem);
  EXPECT_TRUE(result.camera_from_world.rotation.coeffs().allFinite());
  EXPECT_TRUE(result.camera_from_world.translation.allFinite());
}

}  // namespace
}  // namespace orbslam
