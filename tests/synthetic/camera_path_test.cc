// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

class EveryMotion : public testing::TestWithParam<Motion> {};
INSTANTIATE_TEST_SUITE_P(All, EveryMotion, testing::ValuesIn(AllMotions().begin(), AllMotions().end()),
                         [](const auto& motion) { return std::string(MotionName(motion.param)); });

TEST_P(EveryMotion, KeepsTheSpeedLimitsAndHasNoKinks) {
  constexpr double kStepS = 0.01;
  for (const uint64_t seed : {1u, 2u, 3u}) {
    const CameraPath path(GetParam(), seed);
    Eigen::Vector3d last_velocity = Eigen::Vector3d::Zero();
    for (double t = 0; t < MotionDurationS(GetParam()); t += kStepS) {
      if (path.IsCovered(t) || path.IsCovered(t + kStepS)) continue;  // it may be carried anywhere
      const Rigid3d a = path.WorldFromCamera(t), b = path.WorldFromCamera(t + kStepS);
      const Eigen::Vector3d velocity = (b.translation - a.translation) / kStepS;
      EXPECT_LT(velocity.norm(), 0.6);
      EXPECT_LT(AngularDistance(a.rotation, b.rotation) / kStepS, 60 * kDegree);
      if (t > 0 && !path.IsCovered(t - kStepS)) {
        EXPECT_LT((velocity - last_velocity).norm(), 3.5 * kStepS) << "at " << t << " s";
      }
      last_velocity = velocity;
    }
  }
}

TEST_P(EveryMotion, StaysInTheFreePartOfTheRoom) {
  const CameraPath path(GetParam(), 1);
  for (double t = 0; t < MotionDurationS(GetParam()); t += 0.1) {
    const Eigen::Vector3d position = path.WorldFromCamera(t).translation;
    EXPECT_LT(std::abs(position.x()), 1.7);
    EXPECT_LT(std::abs(position.y()), 1.3);
    EXPECT_GT(position.z(), 0.8);
    EXPECT_LT(position.z(), 2.2);
  }
}

TEST(CameraPath, SwingsReachTheirAmplitudeOnEveryAxis) {
  const CameraPath xyz(Motion::kXyz, 1), rpy(Motion::kRpy, 1);
  Eigen::AlignedBox3d places;
  double angle = 0;
  for (double t = 0; t < MotionDurationS(Motion::kXyz); t += 0.05) {
    places.extend(xyz.WorldFromCamera(t).translation);
    angle =
        std::max(angle, AngularDistance(rpy.WorldFromCamera(t).rotation, rpy.WorldFromCamera(0).rotation));
  }
  for (const double extent : places.sizes()) EXPECT_NEAR(extent, 0.6, 0.03);
  EXPECT_NEAR(angle, 25 * kDegree, 2 * kDegree);
}

TEST(CameraPath, LoopTurnsOnceRoundAndComesBack) {
  const CameraPath path(Motion::kLoop, 1);
  const double round_s = MotionDurationS(Motion::kLoop) / 1.1;
  const Rigid3d start = path.WorldFromCamera(0), half = path.WorldFromCamera(round_s / 2);
  const Rigid3d end = path.WorldFromCamera(round_s);
  EXPECT_LT((end.translation - start.translation).norm(), 0.03);
  EXPECT_LT(AngularDistance(end.rotation, start.rotation), 3 * kDegree);
  EXPECT_GT((half.translation - start.translation).norm(), 2.0);
  EXPECT_GT(AngularDistance(half.rotation, start.rotation), 160 * kDegree);
}

TEST(CameraPath, HeldInPlaceTremblesALittleAndEveryHandInItsOwnWay) {
  const CameraPath hand(Motion::kStatic, 1), other_hand(Motion::kStatic, 2);
  Eigen::AlignedBox3d places;
  for (double t = 0; t < MotionDurationS(Motion::kStatic); t += 0.05)
    places.extend(hand.WorldFromCamera(t).translation);
  EXPECT_LT(places.sizes().maxCoeff(), 0.02);
  EXPECT_GT(places.sizes().minCoeff(), 0.003);
  EXPECT_NE(hand.WorldFromCamera(3).translation, other_hand.WorldFromCamera(3).translation);
}

TEST(CameraPath, HalfsphereLooksOutwardsFromASphereOfAMetre) {
  const CameraPath path(Motion::kHalfsphere, 1);
  const Eigen::Vector3d start = path.WorldFromCamera(0).translation;
  Eigen::AlignedBox3d places;
  double angle = 0;
  for (double t = 0; t < MotionDurationS(Motion::kHalfsphere); t += 0.05) {
    const Rigid3d pose = path.WorldFromCamera(t);
    places.extend(pose.translation);
    angle = std::max(angle, AngularDistance(pose.rotation, path.WorldFromCamera(0).rotation));
  }
  EXPECT_LT((places.center() - start).norm(), 0.5);
  EXPECT_GT(places.sizes().x(), 0.4);
  EXPECT_LT(places.sizes().maxCoeff(), 1.0);
  EXPECT_GT(angle, 25 * kDegree);
}

TEST(CameraPath, KidnappedCameraIsCoveredAndThenElsewhereOnTheKnownRound) {
  const CameraPath kidnap(Motion::kKidnap, 1), loop(Motion::kLoop, 1);
  double covered_s = 0, before_s = 0, after_s = 0;
  constexpr double kStepS = 0.01;
  for (double t = 0; t < MotionDurationS(Motion::kKidnap); t += kStepS) {
    if (kidnap.IsCovered(t))
      covered_s += kStepS, after_s = t + kStepS;
    else if (covered_s == 0)
      before_s = t;
    EXPECT_FALSE(loop.IsCovered(t));
  }
  EXPECT_NEAR(covered_s, 2, 0.02);
  const Rigid3d before = kidnap.WorldFromCamera(before_s), after = kidnap.WorldFromCamera(after_s + kStepS);
  EXPECT_GT(AngularDistance(before.rotation, after.rotation), 60 * kDegree);
  double nearest_m = 10;  // of the round's places to the one after
  for (double t = 0; t < before_s; t += kStepS) {
    nearest_m = std::min(nearest_m, (loop.WorldFromCamera(t).translation - after.translation).norm());
  }
  EXPECT_LT(nearest_m, 0.03);
}

TEST(CameraPath, OnlyKnownNamesAreMotions) {
  EXPECT_EQ(ParseMotion("loop"), Motion::kLoop);
  for (const Motion motion : AllMotions()) EXPECT_EQ(ParseMotion(MotionName(motion)), motion);
  EXPECT_FALSE(ParseMotion("Loop").has_value());
  EXPECT_FALSE(ParseMotion("").has_value());
}

}  // namespace
}  // namespace orbslam
