// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/relative_pose.h"

#include <gtest/gtest.h>

#include <limits>

#include "optimization/scene.h"

namespace orbslam {
namespace {

// n matches, every third point noisy by 1 cm of depth if there is noise at all; the first share of them
// wrong.
RelativePoseProblem RandomProblem(const Rigid3d& b_from_a, int n, double noise_px, double outlier_share,
                                  Rng* rng) {
  RelativePoseProblem problem{test::Kinect(), {}};
  const StereoIntrinsics& k = problem.intrinsics;
  while (static_cast<int>(problem.matches.size()) < n) {
    const Eigen::Vector3d x_a = test::RandomVisiblePoint(k, rng);
    Eigen::Vector3d x_b = b_from_a * x_a;
    if (x_b.z() < 0.5) continue;
    if (static_cast<double>(problem.matches.size()) < outlier_share * n)
      x_b = test::RandomVisiblePoint(k, rng);
    const Eigen::Vector2d pixel_a = test::Measure(k, x_a, noise_px, true, rng).head<2>();
    const Eigen::Vector2d pixel_b = test::Measure(k, x_b, noise_px, true, rng).head<2>();
    const double depth_noise = noise_px > 0 ? 0.002 : 0;
    problem.matches.push_back({x_a * (1 + depth_noise * rng->Gaussian()),
                               x_b * (1 + depth_noise * rng->Gaussian()), pixel_a, pixel_b, 1, 1});
  }
  return problem;
}

double AngleError(const Rigid3d& a, const Rigid3d& b) { return AngularDistance(a.rotation, b.rotation); }

TEST(RelativePose, HalfOutliersDoNotMatter) {
  Rng rng(1);
  for (int trial = 0; trial < 30; ++trial) {
    const Rigid3d b_from_a = test::RandomMotion(&rng, 0.3, 0.3);
    const RelativePoseProblem problem = RandomProblem(b_from_a, 100, 1, 0.5, &rng);
    const auto estimate = EstimateRelativePose(problem, {}, &rng);
    ASSERT_TRUE(estimate.has_value());
    const RelativePoseResult refined = RefineRelativePose(problem, estimate->b_from_a);
    EXPECT_LT(AngleError(refined.b_from_a, b_from_a), 3e-3) << trial;
    EXPECT_LT((refined.b_from_a.translation - b_from_a.translation).norm(), 0.01) << trial;
    int kept = 0, wrong = 0;
    for (int i = 0; i < 100; ++i) (i < 50 ? wrong : kept) += refined.is_inlier[i];
    EXPECT_GT(kept, 40);
    EXPECT_LE(wrong, 1);
  }
}

TEST(RelativePose, IsExactWithoutNoise) {
  Rng rng(2);
  const Rigid3d b_from_a = test::RandomMotion(&rng, 0.3, 0.3);
  const RelativePoseProblem problem = RandomProblem(b_from_a, 30, 0, 0, &rng);
  const auto estimate = EstimateRelativePose(problem, {}, &rng);
  ASSERT_TRUE(estimate.has_value());
  EXPECT_LT((estimate->b_from_a.translation - b_from_a.translation).norm(), 1e-9);
  const RelativePoseResult refined =
      RefineRelativePose(problem, test::RandomMotion(&rng, 0.02, 0.02) * b_from_a);
  EXPECT_LT((refined.b_from_a.translation - b_from_a.translation).norm(), 1e-8);
  EXPECT_LT(AngleError(refined.b_from_a, b_from_a), 1e-8);
  EXPECT_EQ(refined.num_inliers, 30);
}

TEST(RelativePose, SameSeedSameResult) {
  Rng rng(3);
  const RelativePoseProblem problem = RandomProblem(test::RandomMotion(&rng, 0.2, 0.2), 60, 1, 0.3, &rng);
  Rng one(7), two(7);
  const auto a = EstimateRelativePose(problem, {}, &one), b = EstimateRelativePose(problem, {}, &two);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->b_from_a.translation, b->b_from_a.translation);
  EXPECT_EQ(a->is_inlier, b->is_inlier);
}

TEST(RelativePose, TooFewMatchesGiveNothing) {
  Rng rng(4);
  for (int n = 0; n < 3; ++n) {
    const RelativePoseProblem problem = RandomProblem(Rigid3d(), n, 0, 0, &rng);
    EXPECT_FALSE(EstimateRelativePose(problem, {.min_inliers = 0}, &rng).has_value());
    EXPECT_EQ(RefineRelativePose(problem, Rigid3d()).num_inliers, 0);
  }
}

TEST(RelativePose, CollinearAndUnusablePointsGiveNothing) {
  Rng rng(5);
  RelativePoseProblem line{test::Kinect(), {}}, unusable = RandomProblem(Rigid3d(), 20, 0, 0, &rng);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d x(0.05 * i, 0.02 * i, 2 + 0.01 * i);
    const Eigen::Vector2d pixel = line.intrinsics.Project(x).head<2>();
    line.matches.push_back({x, x, pixel, pixel, 1, 1});
    unusable.matches[i].point_a.y() = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_FALSE(EstimateRelativePose(line, {}, &rng).has_value());
  EXPECT_FALSE(EstimateRelativePose(unusable, {}, &rng).has_value());
  const RelativePoseResult refined = RefineRelativePose(unusable, Rigid3d());
  EXPECT_EQ(refined.num_inliers, 0);
  EXPECT_TRUE(refined.b_from_a.translation.isZero(0));
  EXPECT_TRUE(RefineRelativePose(line, Rigid3d()).b_from_a.translation.allFinite());
}

}  // namespace
}  // namespace orbslam
