// SPDX-License-Identifier: GPL-3.0-or-later
#include "icp.h"

#include <gtest/gtest.h>

#include "depth_scene.h"
#include "icp_pairs.h"
#include "orbslam/geometry/so3.h"

namespace orbslam::test {
namespace {

/// Two upright posts on a floor: no motion leaves all of it alike.
float RoomDepth(float x, float y) {
  const float left = PostOnFloor(x + 0.45f, y, 0.2f), right = PostOnFloor(x - 0.35f, y, 0.1f);
  return left > 0 && right > 0 ? std::min(left, right) : std::max(left, right);
}

WorkingFrame Room() { return See(RoomDepth); }

PairSums Sum(const WorkingFrame& source, const WorkingFrame& target, const Rigid3d& target_from_source,
             int stride, const cv::Mat1b* ignored_source = nullptr,
             const cv::Mat1b* ignored_target = nullptr) {
  PairSums sums;
  AddPairs(kCellCamera, source, ignored_source, {&target, ignored_target, {}}, target_from_source, {}, stride,
           &sums);
  return sums;
}

int NumMeasured(const WorkingFrame& frame, int stride) {
  int count = 0;
  for (int v = stride / 2; v < kCellCamera.height; v += stride)
    for (int u = stride / 2; u < kCellCamera.width; u += stride) count += frame.normal_z(v, u) != 0;
  return count;
}

/// Also where a row of points does not end with a block of them.
TEST(AddPairs, EachPointOfAFrameMeetsItself) {
  const WorkingFrame room = Room();
  for (const int stride : {1, 2, 3, 4}) {
    const PairSums sums = Sum(room, room, {}, stride);
    EXPECT_GT(sums.num_pairs, 100);
    EXPECT_EQ(sums.num_pairs, NumMeasured(room, stride)) << stride;
    EXPECT_EQ(sums.num_fitting, sums.num_pairs);
    for (int a = 0; a < 6; ++a) EXPECT_NEAR(sums(a, 6), 0, 1e-5f * std::sqrt(sums(a, a))) << a;
  }
}

/// The last of a row, too.
TEST(AddPairs, PointsAtTheRimMeetWhereTheyFall) {
  constexpr int kShift = 8, kRim = 2;  // cells; no normals at the rim
  const WorkingFrame wall = See([](float, float) { return 1.f; });
  const Rigid3d to_the_left{Rigid3d().rotation, {-kShift / 130.0, 0, 0}};
  for (const int stride : {1, 2, 3, 4}) {
    int columns = 0, rows = 0;
    for (int u = stride / 2; u < kCellCamera.width; u += stride) columns += u - kShift >= kRim;
    for (int v = stride / 2; v < kCellCamera.height; v += stride)
      rows += v >= kRim && v < kCellCamera.height - kRim;
    EXPECT_EQ(Sum(wall, wall, to_the_left, stride).num_pairs, columns * rows) << stride;
  }
}

/// Of a small motion d the residuals are J d, so that J^T W r = (J^T W J) d, in each of its six directions.
TEST(AddPairs, TheJacobianTellsWhatASmallMotionDoes) {
  const WorkingFrame room = Room();
  const PairSums sums = Sum(room, room, {}, 2);
  for (int a = 0; a < 6; ++a) {
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    step[a] = 2e-4;
    const PairSums moved = Sum(room, room, {So3Exp(step.head<3>()), step.tail<3>()}, 2);
    EXPECT_NEAR(moved(a, 6), sums(a, a) * static_cast<float>(step[a]), 0.1f * moved(a, 6)) << a;
  }
}

TEST(AddPairs, WhatIsLeftOutOnEitherSideHasNoSay) {
  const WorkingFrame room = Room();
  cv::Mat1b left(room.depth_m.size(), uint8_t{0});
  left.colRange(0, kCellCamera.width / 2).setTo(255);
  const PairSums without_source = Sum(room, room, {}, 2, &left),
                 without_target = Sum(room, room, {}, 2, nullptr, &left);
  const int all = Sum(room, room, {}, 2).num_pairs;
  EXPECT_GT(without_source.num_pairs, 0);
  EXPECT_LT(without_source.num_pairs, all);
  EXPECT_EQ(without_target.num_pairs, without_source.num_pairs);
  for (int a = 0; a < 6; ++a) EXPECT_EQ(without_target(a, a), without_source(a, a));
}

TEST(AddPairs, SurfacesThatAreFarApartAreNoPairs) {
  const WorkingFrame near = See([](float, float) { return 1.f; }),
                     far = See([](float, float) { return 1.3f; });
  const PairSums apart = Sum(near, far, {}, 2);
  EXPECT_EQ(apart.num_pairs, 0);
  EXPECT_EQ(apart.num_fitting, 0);
  for (int a = 0; a < 6; ++a) EXPECT_EQ(apart(a, a), 0);
}

TEST(AlignDepth, FindsTheTurnOfTheCamera) {
  const Eigen::Quaterniond truth = So3Exp({0.002, -0.004, 0.003});
  const WorkingFrame room = Room(), turned = See([&](float x, float y) {
                                      const Eigen::Vector3f ray =
                                          truth.cast<float>() * Eigen::Vector3f(x, y, 1);  // in the room
                                      return RoomDepth(ray.x() / ray.z(), ray.y() / ray.z()) / ray.z();
                                    });
  const IcpTarget target{&room, nullptr, {}};
  const IcpResult result = AlignDepth(kCellCamera, turned, nullptr, {&target, 1}, {},
                                      IsotropicInformation(1, 1), {.iterations = 10});
  EXPECT_GT(result.FitShare(), 0.95);
  EXPECT_LT(result.base_from_source.translation.norm(), 0.001);
  EXPECT_LT(AngularDistance(result.base_from_source.rotation, truth), 0.001);
}

/// A wall says nothing of motions along it.
TEST(AlignDepth, WhatDepthLeavesOpenThePriorTells) {
  const WorkingFrame wall = See([](float, float) { return 2.f; });
  const Rigid3d prior{Eigen::Quaterniond::Identity(), {0.02, -0.01, 0.004}};
  const IcpTarget target{&wall, nullptr, {}};
  const IcpResult result =
      AlignDepth(kCellCamera, wall, nullptr, {&target, 1}, prior, IsotropicInformation(0.01, 0.01), {});
  EXPECT_NEAR(result.base_from_source.translation.x(), 0.02, 1e-4);
  EXPECT_NEAR(result.base_from_source.translation.y(), -0.01, 1e-4);
  EXPECT_NEAR(result.base_from_source.translation.z(), 0, 1e-4);
}

}  // namespace
}  // namespace orbslam::test
