// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/camera_path.h"

#include <gtest/gtest.h>

#include <numbers>

#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

class EveryMotion : public testing::TestWithParam<Motion> {};
INSTANTIATE_TEST_SUITE_P(All, EveryMotion,
                         testing::Values(Motion::kXyz, Motion::kRpy, Motion::kLoop, Motion::kStatic));

TEST_P(EveryMotion, KeepsTheSpeedLimitsAndHasNoKinks) {
  constexpr double kStepS = 0.01;
  for (const uint64_t seed : {1u, 2u, 3u}) {
    const CameraPath path(GetParam(), seed);
    Eigen::Vector3d last_velocity = Eigen::Vector3d::Zero();
    for (double t = 0; t < MotionDurationS(GetParam()); t += kStepS) {
      const Rigid3d a = path.WorldFromCamera(t), b = path.WorldFromCamera(t + kStepS);
      const Eigen::Vector3d velocity = (b.translation - a.translation) / kStepS;
      EXPECT_LT(velocity.norm(), 0.5);
      EXPECT_LT(AngularDistance(a.rotation, b.rotation) / kStepS, 40 * kDegree);
      if (t > 0) {
        EXPECT_LT((velocity - last_velocity).norm(), 2.5 * kStepS) << "at " << t << " s";
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
  for (const double extent : places.sizes()) EXPECT_NEAR(extent, 0.6, 0.02);
  EXPECT_NEAR(angle, 25 * kDegree, 1.5 * kDegree);
}

TEST(CameraPath, LoopTurnsOnceRoundAndComesBack) {
  const CameraPath path(Motion::kLoop, 1);
  const double round_s = MotionDurationS(Motion::kLoop) / 1.1;
  const Rigid3d start = path.WorldFromCamera(0), half = path.WorldFromCamera(round_s / 2);
  const Rigid3d end = path.WorldFromCamera(round_s);
  EXPECT_LT((end.translation - start.translation).norm(), 0.02);
  EXPECT_LT(AngularDistance(end.rotation, start.rotation), 2 * kDegree);
  EXPECT_GT((half.translation - start.translation).norm(), 2.0);
  EXPECT_GT(AngularDistance(half.rotation, start.rotation), 160 * kDegree);
}

TEST(CameraPath, TripodStandsStillAndHandsDoNot) {
  const CameraPath tripod(Motion::kStatic, 1), hand(Motion::kXyz, 1), other_hand(Motion::kXyz, 2);
  EXPECT_EQ(tripod.WorldFromCamera(0).translation, tripod.WorldFromCamera(3).translation);
  EXPECT_NE(hand.WorldFromCamera(3).translation, other_hand.WorldFromCamera(3).translation);
}

TEST(CameraPath, OnlyKnownNamesAreMotions) {
  EXPECT_EQ(ParseMotion("loop"), Motion::kLoop);
  EXPECT_FALSE(ParseMotion("Loop").has_value());
  EXPECT_FALSE(ParseMotion("").has_value());
}

}  // namespace
}  // namespace orbslam
