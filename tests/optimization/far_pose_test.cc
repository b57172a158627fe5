// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/far_pose.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "optimization/scene.h"

namespace orbslam {
namespace {

/// A room with a wall and things before it, 2.6 to 3.6 m away, and somebody or something at 1.5 m.
class FarPoseTest : public testing::Test {
 protected:
  static constexpr double kNoisePx = 0.18;  // of sharp corners: a part of the given pixel
  static constexpr double kStepM = 0.02;

  Eigen::Vector3d PointBetween(double from_m, double to_m, double u_min, double u_max) {
    const StereoIntrinsics& k = problem_.intrinsics;
    const double z = rng_.Uniform(from_m, to_m), u = rng_.Uniform(u_min, u_max), v = rng_.Uniform(0, 480);
    return {(u - k.cx) / k.fx * z, (v - k.cy) / k.fy * z, z};
  }
  /// Points that have moved since they were mapped, in the camera's frame.
  void Add(int num, double from_m, double to_m, const Eigen::Vector3d& moved_m) {
    for (int i = 0; i < num; ++i) {
      const Eigen::Vector3d x = PointBetween(from_m, to_m, 100, 540);
      problem_.observations.push_back(
          {Inverse(truth_) * (x - moved_m), test::Measure(problem_.intrinsics, x, kNoisePx, true, &rng_), 1});
    }
  }
  void AddWall(int num) { Add(num, 2.6, 3.6, {0, 0, 0}); }
  void AddSomebody(int num, double moved_m) { Add(num, 1.45, 1.6, {moved_m, 0, 0}); }

  std::optional<FarPose> Find() { return FindContradictingFarPose(problem_, OptimizePose(problem_)); }
  double ErrorM(const PoseResult& result) const {
    return (Inverse(result.camera_from_world).translation - Inverse(truth_).translation).norm();
  }

  Rng rng_{5};
  const Rigid3d truth_ = test::RandomMotion(&rng_, 0.5, 0.5);
  PoseProblem problem_{test::Kinect(), truth_, {}};
};

TEST_F(FarPoseTest, FewNearPointsThatMoveTakeThePoseWithThemAndAreFound) {
  AddWall(300);
  AddSomebody(40, kStepM);
  const PoseResult all = OptimizePose(problem_);
  EXPECT_GT(ErrorM(all), kStepM / 3) << "else this were no trouble";
  const auto far = FindContradictingFarPose(problem_, all);
  ASSERT_TRUE(far);
  EXPECT_LT(ErrorM(far->pose), kStepM / 5);
  EXPECT_GT(far->split_m, 1.6);
  EXPECT_LT(far->split_m, 2.6);
  const auto& is_inlier = far->pose.is_inlier;
  EXPECT_GT(std::count(is_inlier.begin(), is_inlier.begin() + 300, 1), 280);
  EXPECT_LT(std::count(is_inlier.begin() + 300, is_inlier.end(), 1), 5);
  EXPECT_EQ(std::ranges::count(is_inlier, 1), far->pose.num_inliers);
}

TEST_F(FarPoseTest, WhatRestsNearDoesNotContradict) {
  for (int trial = 0; trial < 100; ++trial) {
    problem_.observations.clear();
    AddWall(100 + 4 * trial);
    AddSomebody(20 + trial, 0);
    EXPECT_FALSE(Find()) << trial;
  }
}

TEST_F(FarPoseTest, WrongMatchesNearDoNotMakeTheOthersWrong) {
  AddWall(300);
  AddSomebody(40, 0);
  AddSomebody(30, 0.2);
  EXPECT_FALSE(Find());
}

TEST_F(FarPoseTest, NearPointsThatOutnumberTheFarAreRight) {
  AddWall(150);
  AddSomebody(200, kStepM);
  EXPECT_FALSE(Find());
}

TEST_F(FarPoseTest, FarPointsThatMoveApartProveNothing) {
  AddWall(120);
  Add(120, 2.6, 3.6, {0.1, 0.05, 0});
  AddSomebody(40, kStepM);
  EXPECT_FALSE(Find());
}

TEST_F(FarPoseTest, FewFarPointsProveNothing) {
  AddWall(45);
  AddSomebody(20, kStepM);
  EXPECT_FALSE(Find());
}

TEST_F(FarPoseTest, OfNothingThereIsNone) { EXPECT_FALSE(Find()); }

}  // namespace
}  // namespace orbslam
