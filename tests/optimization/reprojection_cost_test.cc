// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimization/reprojection_cost.h"

#include <ceres/manifold.h>
#include <ceres/manifold_test_utils.h>
#include <gtest/gtest.h>

#include "optimization/numeric_jacobian.h"
#include "optimization/pose_block.h"
#include "optimization/scene.h"

namespace orbslam {
namespace {

std::vector<double> ToStd(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

TEST(ReprojectionCost, JacobiansAgreeWithNumericOnes) {
  Rng rng(1);
  const StereoIntrinsics k = test::Kinect();
  for (int trial = 0; trial < 100; ++trial) {
    const Rigid3d camera_from_world = test::RandomMotion(&rng, 1, 1);
    const Eigen::Vector3d x = test::RandomVisiblePoint(k, &rng);
    const ReprojectionCost cost(k, {0, 0, test::Measure(k, x, 5, trial % 2 == 0, &rng), rng.Uniform(0.1, 2)},
                                /*depth_weight=*/rng.Uniform(0.05, 1));
    const Eigen::Quaterniond& q = camera_from_world.rotation;
    test::ExpectJacobiansAreRight(cost,
                                  {{q.x(), q.y(), q.z(), q.w()},
                                   ToStd(camera_from_world.translation),
                                   ToStd(Inverse(camera_from_world) * x)},
                                  1e-6);
  }
}

TEST(ReprojectionCost, BehindTheCameraNothingPulls) {
  const ReprojectionCost cost(test::Kinect(), {0, 0, {100, 100, 90}, 1});
  const PoseBlock pose{Rigid3d()};
  const Eigen::Vector3d point(0, 0, -1);
  const double* parameters[] = {pose.rotation.data(), pose.translation.data(), point.data()};
  Eigen::Vector3d residuals;
  Eigen::Matrix3d j = Eigen::Matrix3d::Ones();
  double* jacobians[] = {nullptr, nullptr, j.data()};
  ASSERT_TRUE(cost.Evaluate(parameters, residuals.data(), jacobians));
  EXPECT_GT(residuals.squaredNorm(), 100);
  EXPECT_TRUE(j.isZero(0));
}

TEST(PoseBlock, KeepsThePose) {
  Rng rng(2);
  const Rigid3d pose = test::RandomMotion(&rng, 2, 3);
  EXPECT_LT(AngularDistance(PoseBlock(pose).Pose().rotation, pose.rotation), 1e-12);
  EXPECT_EQ(PoseBlock(pose).Pose().translation, pose.translation);
}

}  // namespace
}  // namespace orbslam

namespace ceres {

// The invariants speak of names in this namespace.
TEST(PoseManifold, InvariantsHold) {
  orbslam::Rng rng(3);
  for (int trial = 0; trial < 20; ++trial) {
    Vector x = orbslam::So3Exp(orbslam::test::RandomVector(&rng, 1)).coeffs();
    Vector y = orbslam::So3Exp(orbslam::test::RandomVector(&rng, 1)).coeffs();
    Vector delta = orbslam::test::RandomVector(&rng, 0.3);
    EigenQuaternionManifold manifold;
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
  }
}

}  // namespace ceres
