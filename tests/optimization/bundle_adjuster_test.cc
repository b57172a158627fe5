// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/bundle_adjuster.h"

#include <gtest/gtest.h>

#include "optimization/bundle_scene.h"

namespace orbslam {
namespace {

double MaxPoseErrorM(const BundleProblem& a, const BundleProblem& b) {
  double error = 0;
  for (size_t i = 0; i < a.poses.size(); ++i) {
    const Rigid3d difference = Inverse(a.poses[i].camera_from_world) * b.poses[i].camera_from_world;
    error = std::max(error, difference.translation.norm());
  }
  return error;
}

bool AreIdentical(const BundleProblem& a, const BundleProblem& b) {
  bool same = a.points == b.points;
  for (size_t i = 0; i < a.poses.size(); ++i) {
    const Rigid3d &p = a.poses[i].camera_from_world, &q = b.poses[i].camera_from_world;
    same = same && p.rotation.coeffs() == q.rotation.coeffs() && p.translation == q.translation;
  }
  return same;
}

class BundleAdjusterTest : public ::testing::TestWithParam<BundleOptions::Solver> {};

TEST_P(BundleAdjusterTest, RecoversPosesAndPointsWithoutNoise) {
  Rng rng(1);
  test::BundleScene scene = test::MakeBundleScene({.noise_px = 0}, &rng);
  const BundleSummary summary = SolveBundle({.solver = GetParam()}, {}, &scene.problem);
  EXPECT_TRUE(summary.is_usable);
  EXPECT_LT(summary.final_cost, 1e-3 * summary.initial_cost);
  EXPECT_LT(MaxPoseErrorM(scene.problem, scene.truth), 1e-5);
  for (char inlier : summary.is_inlier) EXPECT_TRUE(inlier);
}

TEST_P(BundleAdjusterTest, WithoutNoiseEveryPointIsOnePlace) {
  Rng rng(1);
  test::BundleScene scene =
      test::MakeBundleScene({.num_free_poses = 28, .views_per_point = 20, .noise_px = 0}, &rng);
  const BundleSummary summary = SolveBundle(
      {.solver = GetParam(), .robust_iterations = 30, .max_point_error_ratio = 4}, {}, &scene.problem);
  for (char inlier : summary.is_inlier) EXPECT_TRUE(inlier);
}

TEST_P(BundleAdjusterTest, TellsOutliersFromInliers) {
  Rng rng(2);
  test::BundleScene scene = test::MakeBundleScene({.noise_px = 0.5, .outlier_share = 0.1}, &rng);
  const BundleSummary summary = SolveBundle({.solver = GetParam()}, {}, &scene.problem);
  EXPECT_LT(MaxPoseErrorM(scene.problem, scene.truth), 5e-3);
  int true_inliers = 0, kept = 0, outliers = 0, wrong = 0;
  for (size_t i = 0; i < summary.is_inlier.size(); ++i) {
    const bool truth = scene.is_true_inlier[i];
    (truth ? true_inliers : outliers) += 1;
    (truth ? kept : wrong) += summary.is_inlier[i];
  }
  EXPECT_GT(kept, 0.9 * true_inliers);
  EXPECT_LT(wrong, 0.02 * outliers);
}

TEST_P(BundleAdjusterTest, FixedPosesDoNotMoveByABit) {
  Rng rng(3);
  const test::BundleScene scene = test::MakeBundleScene({}, &rng);
  BundleProblem solved = scene.problem;
  SolveBundle({.solver = GetParam()}, {}, &solved);
  for (size_t i = 0; i < solved.poses.size(); ++i) {
    const Rigid3d &before = scene.problem.poses[i].camera_from_world,
                  &after = solved.poses[i].camera_from_world;
    EXPECT_EQ(solved.poses[i].is_fixed, before.rotation.coeffs() == after.rotation.coeffs());
    EXPECT_EQ(solved.poses[i].is_fixed, before.translation == after.translation);
  }
}

TEST_P(BundleAdjusterTest, OneThreadRepeatsBitForBit) {
  Rng rng(4);
  const test::BundleScene scene = test::MakeBundleScene({.outlier_share = 0.05}, &rng);
  BundleProblem a = scene.problem, b = scene.problem;
  SolveBundle({.solver = GetParam()}, {}, &a);
  SolveBundle({.solver = GetParam()}, {}, &b);
  EXPECT_TRUE(AreIdentical(a, b));
}

TEST_P(BundleAdjusterTest, PointsAloneCanBeAdjusted) {
  Rng rng(5);
  test::BundleScene scene = test::MakeBundleScene({.noise_px = 0}, &rng);
  scene.problem.poses = scene.truth.poses;
  for (BundlePose& pose : scene.problem.poses) pose.is_fixed = true;
  EXPECT_TRUE(SolveBundle({.solver = GetParam()}, {}, &scene.problem).is_usable);
  double error = 0;
  for (size_t i = 0; i < scene.truth.points.size(); ++i) {
    error = std::max(error, (scene.problem.points[i] - scene.truth.points[i]).norm());
  }
  EXPECT_LT(error, 1e-3);
}

/// The pixels are said to be exact to 1 px, but are to a third; two are then no noise.
TEST_P(BundleAdjusterTest, GatesAreInUnitsOfTheNoiseThereIs) {
  Rng rng(9);
  test::BundleScene scene = test::MakeBundleScene({.noise_px = 0.3}, &rng);
  const auto is_off = [](size_t i) { return i % 20 == 0; };
  for (size_t i = 0; i < scene.problem.observations.size(); ++i) {
    scene.problem.observations[i].inverse_variance = 1;
    if (is_off(i)) scene.problem.observations[i].pixel.y() += 2.2;  // within 95 % of 1 px
  }
  const BundleSummary summary = SolveBundle({.solver = GetParam()}, {}, &scene.problem);
  int num_off = 0, num_off_inliers = 0, num_others = 0, num_other_inliers = 0;
  for (size_t i = 0; i < summary.is_inlier.size(); ++i) {
    (is_off(i) ? num_off : num_others) += 1;
    (is_off(i) ? num_off_inliers : num_other_inliers) += summary.is_inlier[i];
  }
  EXPECT_LT(num_off_inliers, 0.1 * num_off);
  EXPECT_GT(num_other_inliers, 0.97 * num_others);
}

TEST_P(BundleAdjusterTest, APointThatSwaysIsNoPlaceIfMorePosesThanAFewSeeIt) {
  for (const int views : {20, 5}) {
    Rng rng(8);
    test::BundleScene scene =
        test::MakeBundleScene({.num_free_poses = 28, .num_points = 200, .views_per_point = views}, &rng);
    for (BundleObservation& o : scene.problem.observations)
      if (o.point == 0) o.pixel.head<2>() += Eigen::Vector2d::Constant(o.pose % 2 == 0 ? 3 : -3);
    const BundleSummary summary =
        SolveBundle({.solver = GetParam(), .max_point_error_ratio = 4}, {}, &scene.problem);
    int num_of_swaying = 0, num_of_others = 0, num_others = 0;
    for (size_t i = 0; i < summary.is_inlier.size(); ++i) {
      const bool sways = scene.problem.observations[i].point == 0;
      (sways ? num_of_swaying : num_of_others) += summary.is_inlier[i];
      num_others += !sways;
    }
    EXPECT_EQ(num_of_swaying > 0, views == 5) << "a few can do that by chance";
    EXPECT_GT(num_of_others, 0.93 * num_others);
  }
}

/// A scene whose points have depths that are off, for each point alike wherever it is seen from.
test::BundleScene SceneOfWrongDepths(Rng* rng) {
  test::BundleScene scene = test::MakeBundleScene(
      {.num_free_poses = 28, .num_points = 200, .views_per_point = 20, .noise_px = 0.2}, rng);
  std::vector<double> error_px;
  for (size_t p = 0; p < scene.problem.points.size(); ++p) error_px.push_back(rng->Gaussian());
  for (BundleObservation& o : scene.problem.observations)
    if (o.pixel.z() > 0) o.pixel.z() += error_px[o.point];
  return scene;
}

TEST_P(BundleAdjusterTest, ADepthThatIsOffInEveryViewBendsLessIfItIsKnownToBe) {
  double error_m[2];
  for (const int correlation : {0, 1}) {
    Rng rng(10);
    test::BundleScene scene = SceneOfWrongDepths(&rng);
    SolveBundle({.solver = GetParam(),
                 .robust_iterations = 30,
                 .max_chi2_stereo = 1e9,
                 .depth_correlation = static_cast<double>(correlation)},
                {}, &scene.problem);
    error_m[correlation] = MaxPoseErrorM(scene.problem, scene.truth);
  }
  EXPECT_LT(error_m[1], 0.5 * error_m[0]);
}

TEST_P(BundleAdjusterTest, ADepthThatIsTheOnlyOneOfItsPointCountsInFull) {
  Rng rng(11);
  test::BundleScene scene = test::MakeBundleScene({}, &rng);
  int last_point = -1;
  for (BundleObservation& o : scene.problem.observations) {  // a point's follow one another
    if (o.point == last_point) o.pixel.z() = -1;
    last_point = o.point;
  }
  BundleProblem correlated = scene.problem, independent = scene.problem;
  SolveBundle({.solver = GetParam(), .depth_correlation = 0.5}, {}, &correlated);
  SolveBundle({.solver = GetParam()}, {}, &independent);
  EXPECT_TRUE(AreIdentical(correlated, independent));
}

INSTANTIATE_TEST_SUITE_P(Solvers, BundleAdjusterTest,
                         ::testing::Values(BundleOptions::Solver::kDenseSchur,
                                           BundleOptions::Solver::kSparseSchur,
                                           BundleOptions::Solver::kIterativeSchur));

TEST(BundleAdjuster, StoppedBeforeItStartsChangesNothing) {
  Rng rng(6);
  const test::BundleScene scene = test::MakeBundleScene({}, &rng);
  BundleProblem problem = scene.problem;
  std::stop_source stop;
  stop.request_stop();
  const BundleSummary summary = SolveBundle({}, stop.get_token(), &problem);
  EXPECT_TRUE(summary.was_stopped);
  EXPECT_EQ(summary.num_iterations, 0);
  EXPECT_EQ(summary.is_inlier.size(), problem.observations.size());
  EXPECT_TRUE(AreIdentical(problem, scene.problem));
}

TEST(BundleAdjuster, APointThatNobodySeesRightStaysWhereItIs) {
  Rng rng(7);
  test::BundleScene scene = test::MakeBundleScene({}, &rng);
  const int lonely = static_cast<int>(scene.problem.points.size());
  const Eigen::Vector3d behind =
      Inverse(scene.problem.poses[3].camera_from_world) * Eigen::Vector3d(0.1, 0, -2);
  scene.problem.points.push_back(behind);
  scene.problem.points.push_back({1, 2, 3});  // without any observation
  scene.problem.observations.push_back({3, lonely, {10, 10, -1}, 1});
  const BundleSummary summary = SolveBundle({}, {}, &scene.problem);
  EXPECT_TRUE(summary.is_usable);
  EXPECT_FALSE(summary.is_inlier.back());
  EXPECT_EQ(scene.problem.points[lonely], behind);
  EXPECT_EQ(scene.problem.points[lonely + 1], Eigen::Vector3d(1, 2, 3));
}

/// Two views agree on any point between them: one of a wrong match may lie before a lens, where it weighs as
/// much as all others.
TEST(BundleAdjuster, AWrongPointBeforeTheLensDoesNotPullTheCamera) {
  Rng rng(9);
  test::BundleScene scene = test::MakeBundleScene({.noise_px = 0.5}, &rng);
  BundleProblem alone = scene.problem;
  SolveBundle({}, {}, &alone);
  const int wrong = static_cast<int>(scene.problem.points.size());
  const Eigen::Vector3d at_lens =
      Inverse(scene.problem.poses[3].camera_from_world) * Eigen::Vector3d(0.002, 0.001, 0.03);
  scene.problem.points.push_back(at_lens);
  scene.problem.observations.push_back({3, wrong, {360, 280, -1}, 1});
  scene.problem.observations.push_back({4, wrong, {150, 300, -1}, 1});
  const BundleSummary summary = SolveBundle({}, {}, &scene.problem);
  EXPECT_FALSE(summary.is_inlier.back());
  EXPECT_FALSE(summary.is_inlier[summary.is_inlier.size() - 2]);
  EXPECT_LT(MaxPoseErrorM(scene.problem, alone), 1e-4);
}

TEST(BundleAdjuster, AnEmptyProblemIsSolved) {
  BundleProblem problem;
  problem.intrinsics = test::Kinect();
  EXPECT_TRUE(SolveBundle({}, {}, &problem).is_usable);
}

TEST(BundleAdjuster, NumericalFailureLeavesTheProblem) {
  Rng rng(8);
  test::BundleScene scene = test::MakeBundleScene({}, &rng);
  scene.problem.observations[0].pixel.x() = std::nan("");
  const BundleProblem before = scene.problem;
  EXPECT_FALSE(SolveBundle({}, {}, &scene.problem).is_usable);
  EXPECT_TRUE(AreIdentical(scene.problem, before));
}

}  // namespace
}  // namespace orbslam
