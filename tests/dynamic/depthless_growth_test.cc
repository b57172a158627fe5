// SPDX-License-Identifier: GPL-3.0-or-later
#include "depthless_growth.h"

#include <gtest/gtest.h>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

constexpr int kWidth = 48, kHeight = 40;  // cells
constexpr float kGray = 100.f;

cv::Mat1f Cells(float value) { return cv::Mat1f(kHeight, kWidth, value); }

/// A grey picture in which no cell has depth.
WorkingFrame DepthlessFrame() {
  WorkingFrame frame;
  frame.pyramid = {cv::Mat1f(2 * kHeight, 2 * kWidth, kGray), Cells(kGray)};
  frame.depth_m = Cells(0);
  return frame;
}

BackgroundView BackgroundOf(float gray) { return {Cells(2.f), Cells(gray), Cells(gray)}; }

/// Corners everywhere, as far from where static ones would be.
std::vector<TrackedCorner> CornersOff(float residual_px) {
  std::vector<TrackedCorner> corners;
  for (int v = 4; v < 2 * kHeight; v += 8)
    for (int u = 4; u < 2 * kWidth; u += 8) {
      TrackedCorner corner;
      corner.current = cv::Point2f(static_cast<float>(u), static_cast<float>(v));
      corner.residual_px = residual_px;
      corners.push_back(corner);
    }
  return corners;
}

/// Log-odds in the middle, from nothing.
float LogOdds(float background_gray, const std::vector<TrackedCorner>& corners) {
  return DepthlessLogOdds(DepthlessFrame(), Cells(0), BackgroundOf(background_gray), corners,
                          GrowthOptions())(kHeight / 2, kWidth / 2);
}

TEST(DepthlessLogOdds, RestingCornersSpeakOnlyForWhatLooksAsBefore) {
  EXPECT_LT(LogOdds(kGray, CornersOff(0)), LogOdds(kGray, {}));
  EXPECT_FLOAT_EQ(LogOdds(kGray + 50, CornersOff(0)), LogOdds(kGray + 50, {}));
  EXPECT_GT(LogOdds(kGray + 50, {}), 0);
}

/// Somebody close has stopped, and hides all that could be aligned.
TEST(DepthlessLogOdds, RestingCornersDoNotSpeakWhereNothingIsKnown) {
  const BackgroundView unknown{Cells(0), Cells(0), Cells(0)};
  const auto log_odds = [&](const std::vector<TrackedCorner>& corners) {
    return DepthlessLogOdds(DepthlessFrame(), Cells(2), unknown, corners, GrowthOptions())(kHeight / 2,
                                                                                           kWidth / 2);
  };
  EXPECT_FLOAT_EQ(log_odds(CornersOff(0)), log_odds({}));
  EXPECT_GT(log_odds(CornersOff(9)), log_odds({}));
}

TEST(DepthlessLogOdds, MovingCornersSpeakEverywhere) {
  for (const float gray : {kGray, kGray + 50}) EXPECT_GT(LogOdds(gray, CornersOff(9)), LogOdds(gray, {}));
}

TEST(DepthlessLogOdds, CellsWithDepthHaveNone) {
  WorkingFrame frame = DepthlessFrame();
  frame.depth_m.colRange(0, 10) = 1.5f;
  const cv::Mat1f odds =
      DepthlessLogOdds(frame, Cells(3), BackgroundOf(kGray + 50), CornersOff(9), GrowthOptions());
  EXPECT_EQ(cv::countNonZero(odds.colRange(0, 10)), 0);
  EXPECT_EQ(cv::countNonZero(odds.colRange(10, kWidth) > 0), kHeight * (kWidth - 10));
}

TEST(DepthlessLogOdds, AreMeansOverTheDepthlessCellsAround) {
  Rng rng(3);
  WorkingFrame frame = DepthlessFrame();
  cv::Mat1f carried = Cells(0);
  for (float& z : frame.depth_m) z = rng.Uniform() < 0.6 ? 2.f : 0.f;
  for (float& odds : carried) odds = static_cast<float>(rng.Uniform() * 6 - 3);
  GrowthOptions options;
  options.use_background = false;
  const cv::Mat1f odds = DepthlessLogOdds(frame, carried, {}, {}, options);
  const cv::Rect inside(0, 0, kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      if (frame.depth_m(v, u) > 0) continue;
      const cv::Rect around = cv::Rect(u - 2, v - 2, 5, 5) & inside;
      const double mean = cv::mean(carried(around), frame.depth_m(around) == 0)[0];
      ASSERT_NEAR(odds(v, u), options.memory * mean + options.prior, 1e-5) << u << " " << v;
    }
}

class GrowthTest : public testing::Test {
 protected:
  GrowthTest() { moving_.colRange(0, 5) = 255; }

  int NumColumnsGrown(float log_odds) const {
    const cv::Mat1b grown = GrowIntoDepthless(moving_, frame_, Cells(log_odds), Cells(0), options_);
    return cv::countNonZero(grown.row(kHeight / 2)) - 5;
  }

  const GrowthOptions options_;
  WorkingFrame frame_ = DepthlessFrame();
  cv::Mat1b moving_ = cv::Mat1b(kHeight, kWidth, uint8_t{0});
};

TEST_F(GrowthTest, GoesOnAsFarAsTheOddsAllow) {
  EXPECT_EQ(NumColumnsGrown(0), options_.max_steps);
  EXPECT_EQ(NumColumnsGrown(-0.4f), options_.free_steps) << "of similar grey, but likely static";
  EXPECT_EQ(NumColumnsGrown(options_.agrees + options_.prior), 0) << "looks as the static scene";
}

TEST_F(GrowthTest, StopsBeforeAnotherGreyAndBeforeDepth) {
  frame_.pyramid[1].colRange(10, kWidth) = kGray + 50;
  EXPECT_EQ(NumColumnsGrown(0), 5);
  frame_.depth_m.colRange(7, kWidth) = 1.5f;
  EXPECT_EQ(NumColumnsGrown(0), 2);
}

}  // namespace
}  // namespace orbslam
