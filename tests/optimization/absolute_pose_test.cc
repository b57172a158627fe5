// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/absolute_pose.h"

#include <gtest/gtest.h>

#include <limits>

#include "optimization/scene.h"

namespace orbslam {
namespace {

// The first share of the observations are wrong.
std::vector<PoseObservation> RandomObservations(const Rigid3d& camera_from_world, int n, double noise_px,
                                                double outlier_share, Rng* rng) {
  const StereoIntrinsics k = test::Kinect();
  std::vector<PoseObservation> observations;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d x = test::RandomVisiblePoint(k, rng);
    const Eigen::Vector3d seen = i < outlier_share * n ? test::RandomVisiblePoint(k, rng) : x;
    observations.push_back(
        {Inverse(camera_from_world) * x, test::Measure(k, seen, noise_px, i % 2 == 0, rng), 1});
  }
  return observations;
}

TEST(AbsolutePose, HalfOutliersDoNotMatter) {
  Rng rng(1);
  for (int trial = 0; trial < 30; ++trial) {
    const Rigid3d truth = test::RandomMotion(&rng, 1, 2);
    const auto observations = RandomObservations(truth, 80, 0.7, 0.5, &rng);
    const auto estimate = EstimateAbsolutePose(test::Kinect(), observations, {}, &rng);
    ASSERT_TRUE(estimate.has_value()) << trial;
    EXPECT_LT(AngularDistance(estimate->camera_from_world.rotation, truth.rotation), 5e-3) << trial;
    EXPECT_LT((Inverse(estimate->camera_from_world).translation - Inverse(truth).translation).norm(), 0.02)
        << trial;
    int kept = 0, wrong = 0;
    for (int i = 0; i < 80; ++i) (i < 40 ? wrong : kept) += estimate->is_inlier[i];
    EXPECT_GT(kept, 34) << trial;
    EXPECT_LE(wrong, 2) << trial;
  }
}

TEST(AbsolutePose, IsExactWithoutNoise) {
  Rng rng(2);
  const Rigid3d truth = test::RandomMotion(&rng, 1, 2);
  const auto estimate =
      EstimateAbsolutePose(test::Kinect(), RandomObservations(truth, 40, 0, 0, &rng), {}, &rng);
  ASSERT_TRUE(estimate.has_value());
  EXPECT_EQ(estimate->num_inliers, 40);
  EXPECT_LT(AngularDistance(estimate->camera_from_world.rotation, truth.rotation), 1e-3);
}

TEST(AbsolutePose, SameSeedSameResult) {
  Rng rng(3);
  const auto observations = RandomObservations(test::RandomMotion(&rng, 1, 2), 60, 1, 0.3, &rng);
  Rng one(7), two(7);
  const auto a = EstimateAbsolutePose(test::Kinect(), observations, {}, &one);
  const auto b = EstimateAbsolutePose(test::Kinect(), observations, {}, &two);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->camera_from_world.translation, b->camera_from_world.translation);
  EXPECT_EQ(a->is_inlier, b->is_inlier);
}

TEST(AbsolutePose, NoiseAloneIsRefused) {
  Rng rng(4);
  const auto observations = RandomObservations(Rigid3d(), 60, 1, 1.0, &rng);
  EXPECT_FALSE(EstimateAbsolutePose(test::Kinect(), observations, {}, &rng).has_value());
}

TEST(AbsolutePose, DegenerateInputsGiveNothing) {
  Rng rng(5);
  const StereoIntrinsics k = test::Kinect();
  for (int n = 0; n < 4; ++n) {
    const auto few = RandomObservations(Rigid3d(), n, 0, 0, &rng);
    EXPECT_FALSE(EstimateAbsolutePose(k, few, {.min_inliers = 0}, &rng).has_value());
  }
  std::vector<PoseObservation> line, unusable = RandomObservations(Rigid3d(), 20, 0, 0, &rng);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d x(0.05 * i, 0.02 * i, 2 + 0.01 * i);
    line.push_back({x, k.Project(x), 1});
    unusable[i].point_world.x() = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_FALSE(EstimateAbsolutePose(k, line, {}, &rng).has_value());
  EXPECT_FALSE(EstimateAbsolutePose(k, unusable, {}, &rng).has_value());
}

}  // namespace
}  // namespace orbslam
