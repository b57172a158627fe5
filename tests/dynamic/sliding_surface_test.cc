// SPDX-License-Identifier: GPL-3.0-or-later
#include "sliding_surface.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "orbslam/util/random.h"
#include "reference_view.h"

namespace orbslam {
namespace {

constexpr int kWidth = 160, kHeight = 120;
const cv::Rect kBoard(60, 40, 40, 50);  // cells, 1.5 m away, before a wall at 3 m

cv::Mat1f BoardBeforeWall() {
  cv::Mat1f depth_m(kHeight, kWidth, 3.f);
  depth_m(kBoard).setTo(1.5f);
  return depth_m;
}

/// Corners every 5 cells; noise_px is the length of a resting one's residual, at most.
std::vector<TrackedCorner> Corners(cv::Point2f board_excess, float noise_px = 0.1f) {
  const cv::Mat1f depth_m = BoardBeforeWall();
  Rng rng(1);
  std::vector<TrackedCorner> corners;
  for (int v = 2; v < kHeight; v += 5)
    for (int u = 2; u < kWidth; u += 5) {
      TrackedCorner corner;
      corner.current = cv::Point2f(cv::Point(2 * u + 1, 2 * v + 1));
      corner.depth_m = depth_m(v, u);
      corner.excess = {noise_px * static_cast<float>(rng.Uniform(-0.7, 0.7)),
                       noise_px * static_cast<float>(rng.Uniform(-0.7, 0.7))};
      if (kBoard.contains({u, v})) corner.excess += board_excess;
      corner.residual_px = static_cast<float>(cv::norm(corner.excess));
      corners.push_back(corner);
    }
  return corners;
}

cv::Mat1b Sliding(const std::vector<TrackedCorner>& corners) {
  return SlidingCells(BoardBeforeWall(), MakeFlow(corners, {}), {});
}

TEST(SlidingSurface, NothingSlidesWhereCornersRest) {
  for (const float noise_px : {0.f, 0.1f, 1.f, 3.f})
    EXPECT_EQ(cv::countNonZero(Sliding(Corners({}, noise_px))), 0) << noise_px;
}

TEST(SlidingSurface, TheBoardThatMovesSlidesAndTheWallBehindDoesNot) {
  for (const cv::Point2f excess : {cv::Point2f(1, 0), cv::Point2f(0, -2), cv::Point2f(-4, 3)}) {
    cv::Mat1b sliding = Sliding(Corners(excess));
    EXPECT_EQ(cv::countNonZero(sliding(kBoard)), kBoard.area()) << excess;
    sliding(kBoard).setTo(0);
    EXPECT_EQ(cv::countNonZero(sliding), 0) << excess;
  }
}

TEST(SlidingSurface, CornersThatDisagreeAreNoSurface) {
  std::vector<TrackedCorner> corners = Corners({2, 0});
  Rng rng(2);
  for (TrackedCorner& corner : corners)
    if (rng.Uniform() < 0.5) corner.excess = -corner.excess;
  EXPECT_LT(cv::countNonZero(Sliding(corners)), kBoard.area() / 5);
}

TEST(SlidingSurface, ACornerAloneIsNotBelieved) {
  std::vector<TrackedCorner> corners = Corners({});
  TrackedCorner& odd = corners[corners.size() / 2];
  odd.excess = {5, 0}, odd.residual_px = 5;
  EXPECT_EQ(cv::countNonZero(Sliding(corners)), 0);
  EXPECT_EQ(cv::countNonZero(Sliding({odd})), 0);
}

TEST(SlidingSurface, EndsWhereTheDepthJumps) {
  Flow flow = MakeFlow(Corners({1, 0}), {});
  std::erase_if(flow.corners,
                [](const TrackedCorner& corner) { return corner.depth_m > 2; });  // none on the wall
  cv::Mat1b sliding = SlidingCells(BoardBeforeWall(), flow, {});
  EXPECT_EQ(cv::countNonZero(sliding(kBoard)), kBoard.area());
  EXPECT_EQ(cv::countNonZero(sliding), kBoard.area());
}

TEST(SlidingSurface, BeginsInTheCellsOfItsCorners) {
  const Flow flow = MakeFlow(Corners({1, 0}), {});
  cv::Mat1b sliding = SlidingCells(BoardBeforeWall(), flow, {.max_steps = 0});
  int num_on_board = 0;
  for (const TrackedCorner& corner : flow.corners) {
    if (corner.depth_m > 2) continue;
    EXPECT_EQ(sliding(CellOf(corner)), 255) << CellOf(corner);
    ++num_on_board;
  }
  EXPECT_EQ(cv::countNonZero(sliding), num_on_board);
}

TEST(CornerGate, GrowsWithTheNoiseWithinItsBounds) {
  const CornerGateOptions options;
  float last = 0;
  for (const float noise_px : {0.f, 0.1f, 0.2f, 0.5f, 5.f}) {
    const float gate = MakeCornerGate(Corners({}, noise_px), options).moving_px;
    EXPECT_GE(gate, last);
    last = gate;
  }
  EXPECT_EQ(MakeCornerGate(Corners({}, 0), options).moving_px, options.min_px);
  EXPECT_EQ(last, options.max_px);
  EXPECT_EQ(MakeCornerGate({}, options).moving_px, options.max_px);
}

TEST(CornerGate, IsThatOfThoseThatRestThoughHalfOfThePictureSways) {
  const CornerGateOptions options{.min_px = 0.01f};
  std::vector<TrackedCorner> corners = Corners({});
  const float resting_px = MakeCornerGate(corners, options).moving_px;
  for (size_t i = 0; i < corners.size(); i += 2) corners[i].residual_px = 2;
  EXPECT_LT(MakeCornerGate(corners, options).moving_px, 2 * resting_px);
  EXPECT_GT(MakeCornerGate(corners, options).moving_px, resting_px);
}

TEST(FillHoles, KeepsWhatIsMeasuredAndFillsTheRestFromAround) {
  cv::Mat1f depth_m = BoardBeforeWall();
  const cv::Rect hole(90, 10, 70, 60);  // larger than half of what is beside it
  depth_m(hole).setTo(0);
  const cv::Mat1f filled = FillHoles(depth_m);
  for (int i = 0; i < static_cast<int>(filled.total()); ++i) {
    if (depth_m(i) > 0) {
      EXPECT_EQ(filled(i), depth_m(i));
    }
    EXPECT_GE(filled(i), 1.5f);
    EXPECT_LE(filled(i), 3.f + 1e-5f);
  }
  EXPECT_EQ(cv::countNonZero(FillHoles(cv::Mat1f(kHeight, kWidth, 0.f))), 0);
}

}  // namespace
}  // namespace orbslam
