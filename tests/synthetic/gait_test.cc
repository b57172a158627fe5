// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/gait.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orbslam/synthetic/figure.h"

namespace orbslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180, kTickS = 0.005;
const BodySize kSize(1.75);

/// Walks, stops, turns, walks back, sits and stands up.
GaitPlan Outing(double speed) {
  GaitPlan plan({{-1, 0}, 0.4}, kSize.half_stance, kSize.foot);
  plan.Stand(0.5);
  plan.WalkTo({1.2, 0.3}, speed);
  plan.Stand(1.0);
  plan.TurnTo(-2.0);
  plan.WalkTo({-1, 0}, speed);
  plan.TurnTo(0.4);
  plan.SitDown();
  plan.Stand(0.5);
  plan.StandUp();
  plan.Loop();
  return plan;
}

class GaitAtSpeed : public testing::TestWithParam<double> {};

TEST_P(GaitAtSpeed, AFootThatCarriesDoesNotSlide) {
  const GaitPlan plan = Outing(GetParam());
  for (int foot = 0; foot < 2; ++foot) {
    Vector3d print(0, 0, 0);
    bool was_planted = false;
    for (double t = 0; t < plan.duration_s(); t += kTickS) {
      const FootState state = plan.At(t).feet[foot];
      const Vector3d ball = SolePoint(kSize.foot, state, kSize.foot.ball);
      if (state.planted && !was_planted) print = ball;
      // It comes down round the heel: the ball moves by what a pitched sole is shorter on the floor.
      if (state.planted) {
        EXPECT_LT((ball - print).head<2>().norm(), 0.012) << "at " << t;
      }
      was_planted = state.planted;
    }
  }
}

TEST_P(GaitAtSpeed, FeetAreOnTheFloorOrAboveIt) {
  const GaitPlan plan = Outing(GetParam());
  for (double t = 0; t < plan.duration_s(); t += kTickS) {
    const GaitState state = plan.At(t);
    for (const FootState& foot : state.feet) {
      const double heel = SolePoint(kSize.foot, foot, -kSize.foot.heel).z();
      const double ball = SolePoint(kSize.foot, foot, kSize.foot.ball).z();
      const double tip = ball + (kSize.foot.toe - kSize.foot.ball) * std::sin(foot.toe_pitch);
      EXPECT_GT(std::min({heel, ball, tip}), -1e-6) << "at " << t;
      if (foot.planted) {
        EXPECT_NEAR(std::min(heel, ball), 0, 1e-6) << "at " << t;
      }
    }
    EXPECT_TRUE(state.feet[0].planted || state.feet[1].planted) << "at " << t;
  }
}

TEST_P(GaitAtSpeed, BodyAndFeetMoveWithoutJumps) {
  const GaitPlan plan = Outing(GetParam());
  constexpr double kFastestFoot = 5.0;  // m/s: a swinging foot is about thrice as fast as its walker
  for (double t = -1; t < 2 * plan.duration_s(); t += kTickS) {
    const GaitState a = plan.At(t), b = plan.At(t + kTickS);
    EXPECT_LT((a.body.position - b.body.position).norm(), 1.5 * GetParam() * kTickS + 1e-9) << "at " << t;
    for (int foot = 0; foot < 2; ++foot) {
      EXPECT_LT((a.feet[foot].ankle - b.feet[foot].ankle).norm(), kFastestFoot * kTickS) << "at " << t;
    }
  }
}

TEST_P(GaitAtSpeed, TheMiddleOfAWalkHasItsSpeed) {
  GaitPlan plan({{0, 0}, 0}, kSize.half_stance, kSize.foot);
  plan.WalkTo({4, 0}, GetParam());
  const double t = plan.duration_s() / 2, dt = 0.1;
  const Vector2d way = plan.At(t + dt).body.position - plan.At(t).body.position;
  EXPECT_NEAR(way.norm() / dt, GetParam(), 1e-6);
}

TEST_P(GaitAtSpeed, KneesBendAsPeoplesDo) {
  GaitPlan plan({{0, 0}, 0}, kSize.half_stance, kSize.foot);
  plan.WalkTo({4, 0}, GetParam());
  double most = 0, least = 10;
  for (double t = plan.duration_s() * 0.3; t < plan.duration_s() * 0.7; t += kTickS) {
    const BodyPose pose = SolveBodyPose(kSize, plan.At(t), {});
    const double knee = pose[kThighLeft].rotation.angularDistance(pose[kShinLeft].rotation);
    most = std::max(most, knee);
    least = std::min(least, knee);
  }
  EXPECT_GT(most, 35 * kDegree);  // slow walkers bend less than the 65 degrees of a natural cadence
  EXPECT_LT(most, 85 * kDegree);
  EXPECT_LT(least, 25 * kDegree);
}

INSTANTIATE_TEST_SUITE_P(Speeds, GaitAtSpeed, testing::Values(0.3, 0.5, 0.9));

TEST(WalkingAngles, HaveTheirExtremesWhereTheyArePublished) {
  double knee_peak = 0, hip_back = 0;
  for (double phase = 0; phase < 1; phase += 0.01) {
    if (WalkingAngles(phase).knee > WalkingAngles(knee_peak).knee) knee_peak = phase;
    if (WalkingAngles(phase).hip < WalkingAngles(hip_back).hip) hip_back = phase;
    EXPECT_GT(WalkingAngles(phase).knee, -2 * kDegree) << "knees do not bend forwards";
  }
  EXPECT_NEAR(knee_peak, 0.72, 0.04);
  EXPECT_NEAR(hip_back, 0.52, 0.05);
  EXPECT_NEAR(WalkingAngles(knee_peak).knee, 64 * kDegree, 5 * kDegree);
}

TEST(GaitPlan, RepeatsWhenLooped) {
  GaitPlan plan = Outing(0.6);
  const double t = 1.7;
  EXPECT_LT((plan.At(t).body.position - plan.At(t + 3 * plan.duration_s()).body.position).norm(), 1e-9);
  const GaitState later = plan.At(t + 0.5);
  plan.StartAt(0.5);
  EXPECT_EQ(plan.At(t).body.position, later.body.position);
}

}  // namespace
}  // namespace orbslam
