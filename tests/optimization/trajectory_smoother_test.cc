// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/trajectory_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "optimization/acceleration_cost.h"
#include "optimization/numeric_jacobian.h"
#include "optimization/scene.h"

namespace orbslam {
namespace {

using test::RandomMotion;
using test::RandomVector;
using Poses = std::vector<UncertainPose>;

constexpr double kFrameS = 1.0 / 30;
constexpr double kSigmaM = 0.003, kSigmaRad = 0.002;

/// Known alike in all directions.
Matrix6d Information(double sigma_rad, double sigma_m) {
  Matrix6d information = Matrix6d::Zero();
  information.diagonal().head<3>().setConstant(1 / (sigma_rad * sigma_rad));
  information.diagonal().tail<3>().setConstant(1 / (sigma_m * sigma_m));
  return information;
}

/// A hand that swings: 0.5 m/s^2 at most.
Rigid3d SwingingAt(double t_s) {
  return {So3Exp({0.1 * std::sin(2 * t_s), 0.3 * t_s, 0}),
          {0.12 * std::sin(2 * t_s), 0.2 * t_s, std::cos(t_s)}};
}

/// Turns and moves at a constant speed.
Rigid3d SteadyAt(double t_s) { return {So3Exp({0.2 * t_s, 0.1 * t_s, 0}), {0.3 * t_s, 0, -0.5 * t_s}}; }

template <class PathAt>
Poses Sample(const PathAt& at, int n) {
  Poses poses;
  for (int i = 0; i < n; ++i)
    poses.push_back({kFrameS * i, at(kFrameS * i), Information(kSigmaRad, kSigmaM)});
  return poses;
}

Poses Noisy(Poses poses, Rng* rng) {
  for (UncertainPose& pose : poses)
    pose.world_from_camera = pose.world_from_camera * RandomMotion(rng, kSigmaRad, kSigmaM);
  return poses;
}

Poses Smoothed(Poses poses, const MotionPrior& prior = {}) {
  SmoothTrajectory(prior, poses);
  return poses;
}

double DistanceM(const UncertainPose& a, const UncertainPose& b) {
  return (a.world_from_camera.translation - b.world_from_camera.translation).norm();
}
double AngleRad(const UncertainPose& a, const UncertainPose& b) {
  return AngularDistance(a.world_from_camera.rotation, b.world_from_camera.rotation);
}

double RmsM(const Poses& a, const Poses& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::pow(DistanceM(a[i], b[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}
double RmsRad(const Poses& a, const Poses& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::pow(AngleRad(a[i], b[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

void ExpectEqual(const Poses& a, const Poses& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_LE(DistanceM(a[i], b[i]), tolerance) << i;
    EXPECT_LE(AngleRad(a[i], b[i]), tolerance) << i;
  }
}

TEST(TrajectorySmoother, ASteadyMotionStaysAlsoWhereFramesAreMissing) {
  Poses poses = Sample(SteadyAt, 60);
  poses.erase(poses.begin() + 20, poses.begin() + 27);
  poses.erase(poses.begin() + 40);
  ExpectEqual(Smoothed(poses), poses, 1e-9);
}

TEST(TrajectorySmoother, NoiseIsHalvedAndTheMotionKept) {
  Rng rng(1);
  const Poses truth = Sample(SwingingAt, 300), noisy = Noisy(truth, &rng), smoothed = Smoothed(noisy);
  EXPECT_LT(RmsM(smoothed, truth), 0.5 * RmsM(noisy, truth));
  EXPECT_LT(RmsRad(smoothed, truth), 0.8 * RmsRad(noisy, truth));
  EXPECT_LT(RmsM(Smoothed(truth), truth), 0.1 * kSigmaM);
  EXPECT_LT(RmsRad(Smoothed(truth), truth), 0.1 * kSigmaRad);
}

TEST(TrajectorySmoother, ThePriorSaysHowMuch) {
  Rng rng(2);
  const Poses noisy = Noisy(Sample(SwingingAt, 100), &rng);
  const double much = RmsM(Smoothed(noisy, {0.1, 1}), noisy), less = RmsM(Smoothed(noisy, {1, 10}), noisy);
  const double hardly = RmsM(Smoothed(noisy, {1e3, 1e4}), noisy);
  EXPECT_GT(much, 1.1 * less);
  EXPECT_LT(hardly, 1e-3 * less);
  ExpectEqual(Smoothed(noisy, {0, 5}), noisy, 0);
  ExpectEqual(Smoothed(noisy, {0.7, 0}), noisy, 0);
}

TEST(TrajectorySmoother, OfWhatIsNotKnownTheNeighboursTell) {
  const Poses truth = Sample(SteadyAt, 20);
  Poses poses = truth;
  poses[9].world_from_camera =
      poses[9].world_from_camera * Rigid3d{So3Exp({0.02, 0.01, 0}), {0.02, -0.03, 0.01}};
  poses[9].information.setZero();
  ExpectEqual(Smoothed(poses), truth, 1e-5);
  poses[9].information(3, 3) = 1e12;  // its own x, m
  const Poses held = Smoothed(poses);
  const Eigen::Vector3d error_m = Inverse(poses[9].world_from_camera) * held[9].world_from_camera.translation;
  EXPECT_NEAR(error_m.x(), 0, 1e-4);
  EXPECT_NEAR(error_m.y(), 0.03, 0.003);
}

TEST(TrajectorySmoother, TheWorldsFrameDoesNotMatter) {
  Rng rng(3);
  Poses poses = Noisy(Sample(SwingingAt, 60), &rng);
  poses[30].information = Matrix6d::Identity();
  for (int i = 0; i < 60; i += 3) poses[i].information(4, 4) = 1;  // the camera's y is hardly known
  const Rigid3d other_from_world = RandomMotion(&rng, 2, 3);
  Poses expected = Smoothed(poses), moved = poses;
  for (UncertainPose& pose : moved) pose.world_from_camera = other_from_world * pose.world_from_camera;
  for (UncertainPose& pose : expected) pose.world_from_camera = other_from_world * pose.world_from_camera;
  ExpectEqual(Smoothed(moved), expected, 1e-7);
}

TEST(TrajectorySmoother, AJumpIsSeenNearItAlone) {
  Poses poses = Sample(SteadyAt, 60);
  for (size_t i = 30; i < poses.size(); ++i) poses[i].world_from_camera.translation.x() += 1;
  const Poses smoothed = Smoothed(poses);
  for (size_t i = 0; i < poses.size(); ++i)
    EXPECT_LT(DistanceM(smoothed[i], poses[i]), i < 27 || i > 32 ? 0.02 : 0.5) << i;
}

TEST(TrajectorySmoother, APoseThatIsSurelyWrongIsNotBelieved) {
  Poses poses = Sample(SteadyAt, 60);
  for (UncertainPose& pose : poses) pose.information = Information(0.001, 0.001);
  const Poses truth = poses;
  poses[30].world_from_camera.translation.x() += 0.1;
  ExpectEqual(Smoothed(poses), truth, 0.02);
}

TEST(TrajectorySmoother, TheFirstPoseAfterALossIsNoMoreBelievedThanTheNextOnes) {
  const Poses truth = Sample(SteadyAt, 30);
  Poses poses = truth;
  poses[0].world_from_camera.translation.x() += 8 * kSigmaM;
  EXPECT_LT(DistanceM(Smoothed(poses)[0], truth[0]), kSigmaM);
}

TEST(TrajectorySmoother, AFewPosesAndEqualTimesAreNoMotion) {
  for (int n = 0; n < 3; ++n) ExpectEqual(Smoothed(Sample(SwingingAt, n)), Sample(SwingingAt, n), 0);
  Poses poses = Sample(SwingingAt, 20);
  for (int i = 5; i < 9; ++i) poses[i].timestamp_s = poses[4].timestamp_s;
  const Poses smoothed = Smoothed(poses);
  for (const UncertainPose& pose : smoothed) EXPECT_TRUE(pose.world_from_camera.translation.allFinite());
  EXPECT_EQ(DistanceM(smoothed[6], poses[6]), 0);
}

TEST(TrajectorySmoother, AnExactPoseStaysAndTheOthersFollow) {
  Rng rng(5);
  const Poses truth = Sample(SteadyAt, 30);
  Poses poses = Noisy(truth, &rng);
  poses[0] = truth[0];
  poses[0].information.setConstant(std::numeric_limits<double>::infinity());
  const Poses smoothed = Smoothed(poses);
  EXPECT_EQ(DistanceM(smoothed[0], truth[0]), 0);
  EXPECT_EQ(AngleRad(smoothed[0], truth[0]), 0);
  EXPECT_LT(RmsM(smoothed, truth), 0.6 * RmsM(poses, truth));
}

TEST(AccelerationCost, IsTheAccelerationInUnitsOfThePrior) {
  const MotionPrior prior{0.5, 2};
  const double start_s = 3, acceleration_mps2 = 0.3, angular_radps2 = 0.1;
  Poses poses;
  for (const double t_s : {0.0, 0.1, 0.3}) {
    const double turn_rad = angular_radps2 * t_s * t_s / 2;
    const Rigid3d pose{So3Exp({0, turn_rad, 0}), {0, 0, 1 - acceleration_mps2 * t_s * t_s / 2}};
    poses.push_back({start_s + t_s, pose, Matrix6d::Zero()});
  }
  const AccelerationCost cost(prior, poses[0], poses[1], poses[2]);
  const PoseCorrection none{};
  const double* corrections[] = {none.data(), none.data(), none.data()};
  Vector6d residuals, expected;
  ASSERT_TRUE(cost.Evaluate(corrections, residuals.data(), nullptr));
  expected << 0, angular_radps2 / 2, 0, 0, 0, -acceleration_mps2 / 0.5;
  EXPECT_LT((residuals - expected).norm(), 1e-9);
}

TEST(AccelerationCost, JacobiansAreRight) {
  Rng rng(4);
  const Poses poses = Noisy(Sample(SwingingAt, 3), &rng);
  const std::vector<double> correction{0.01, 0.02, -0.01, 0.1, -0.2, 0.3};
  test::ExpectJacobiansAreRight(AccelerationCost({}, poses[0], poses[1], poses[2]),
                                {correction, correction, correction}, 1e-6);
}

}  // namespace
}  // namespace orbslam
