// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "orbslam/map/invariants.h"
#include "orbslam/tracking/tracking.h"
#include "support/matchers.h"
#include "support/synthetic_view.h"

namespace orbslam::test {
namespace {

/// Grey noise with corners of several pixels.
cv::Mat Noise(const cv::Size& size, uint64_t seed) {
  cv::Mat coarse(size.height / 4, size.width / 4, CV_8UC1), fine;
  cv::RNG(seed).fill(coarse, cv::RNG::UNIFORM, 0, 256);
  cv::resize(coarse, fine, size, 0, 0, cv::INTER_LINEAR);
  return fine;
}

/// A camera that rests before a wall, and a board that slides along between them.
class MaskedTrackingTest : public testing::Test {
 protected:
  static constexpr float kWallM = 2.5, kBoardM = 1.5;
  static constexpr int kSpeedPx = 6, kNoBoard = -1;

  RgbdImage Image(int board_u) {
    RgbdImage image;
    image.id = FrameId(num_shown_);
    image.timestamp_s = num_shown_++ / 30.0;
    image.gray = wall_.clone();
    image.depth_m = cv::Mat(size_, CV_32FC1, cv::Scalar(kWallM));
    if (board_u != kNoBoard) {
      board_.copyTo(image.gray(BoardAt(board_u)));
      image.depth_m(BoardAt(board_u)) = kBoardM;
    }
    image.gray = Shifted(image.gray);
    return image;
  }
  /// As seen by a camera that has gone to the right: new things come in there.
  cv::Mat Shifted(const cv::Mat& image) const {
    if (shifted_px_ == 0) return image;
    cv::Mat shifted;
    cv::hconcat(image.colRange(shifted_px_, image.cols), beside_.colRange(0, shifted_px_), shifted);
    return shifted;
  }
  cv::Rect BoardAt(int board_u) const { return {board_u, 140, board_.cols, board_.rows}; }
  cv::Mat Mask(const cv::Rect& moving) const {
    cv::Mat mask = cv::Mat::zeros(size_, CV_8UC1);
    mask(moving) = 255;
    return mask;
  }
  FrameReport Show(int board_u, const cv::Mat& mask, const std::string& fail_open_reason = {}) {
    return tracking_.Process(Image(board_u), {}, [&](const Rigid3d&) {
      DynamicMask result;
      result.mask = mask;
      result.fail_open_reason = fail_open_reason;
      return result;
    });
  }
  FrameReport ShowMasked(int board_u) { return Show(board_u, Mask(BoardAt(board_u))); }
  /// Somewhere: what else it did does not matter.
  void ShowThatSomethingMoves() { Show(100, Mask({0, 0, 20, 20})); }

  static bool IsOnBoard(const MapPoint& point) { return point.position_world.z() < (kBoardM + kWallM) / 2; }
  int NumPointsOnBoard() const {
    int count = 0;
    const auto map = map_.Read();
    for (const MapPoint& point : map->MapPoints()) count += IsOnBoard(point);
    return count;
  }
  int NumObservationsOfBoardSince(double since_s) const {
    int count = 0;
    const auto map = map_.Read();
    for (const MapPoint& point : map->MapPoints())
      for (const Observation& observation : point.observations)
        count += IsOnBoard(point) && map->Find(observation.keyframe)->timestamp_s > since_s;
    return count;
  }
  int NumOnBoard(const std::vector<Sighting>& sightings) const {
    const auto map = map_.Read();
    return static_cast<int>(std::ranges::count_if(sightings, [&](const Sighting& sighting) {
      const MapPoint* point = map->Find(sighting.point);
      return point != nullptr && IsOnBoard(*point);
    }));
  }

  const Sensor sensor_ = KinectSensor();
  const cv::Size size_{sensor_.camera.width, sensor_.camera.height};
  const cv::Mat wall_ = Noise(size_, 1), board_ = Noise({200, 200}, 2), beside_ = Noise(size_, 3);
  uint32_t num_shown_ = 0;
  int shifted_px_ = 0;
  Map map_{MapData(sensor_.pyramid)};
  Tracking tracking_{sensor_, OrbExtractorOptions(), TrackingOptions(), KeyFramePolicyOptions(), nullptr,
                     &map_};
};

TEST_F(MaskedTrackingTest, WhatIsMaskedIsNeitherFollowedNorMapped) {
  for (int i = 0; i < 20; ++i) {
    const FrameReport report = ShowMasked(100 + kSpeedPx * i);
    ASSERT_EQ(report.state, TrackingState::kOk);
    EXPECT_THAT(*report.world_from_camera, Rigid3dNear(Rigid3d(), 0.002, 0.002));
    EXPECT_GT(report.num_dropped_keypoints, 50);
    EXPECT_GT(report.num_keypoints, 950) << "the wall has the board's share too";
  }
  EXPECT_EQ(NumPointsOnBoard(), 0);
}

TEST_F(MaskedTrackingTest, PointsOnWhatTurnsOutToMoveAreErasedAndOthersStay) {
  for (int i = 0; i < 3; ++i) Show(100, {});
  const int num_on_board = NumPointsOnBoard(), num_points = map_.Read()->num_points();
  ASSERT_GT(num_on_board, 50);
  for (int i = 0; i < 6; ++i) ShowMasked(100 + i);
  EXPECT_LT(NumPointsOnBoard(), 0.25 * num_on_board) << "all but those at the rim";
  EXPECT_GE(map_.Read()->num_points(), num_points - num_on_board);
  EXPECT_THAT(FindBrokenInvariants(*map_.Read()), testing::IsEmpty());
}

/// It may have moved for a while before anyone saw that it does.
TEST_F(MaskedTrackingTest, WhatWasSeenLatelyOfWhatTurnsOutToMoveNoLongerCounts) {
  const cv::Mat most = Mask({size_.width / 4, 0, 3 * size_.width / 4, size_.height});
  for (int i = 0; i < 45; ++i) Show(0, most);
  ASSERT_TRUE(Show(0, {}).new_keyframe) << "much has come into view";
  const double second_ago_s = num_shown_ / 30.0 - 1;
  const int num_on_board = NumPointsOnBoard(), num_lately = NumObservationsOfBoardSince(second_ago_s);
  ASSERT_GT(num_lately, 50);
  ShowMasked(0);
  EXPECT_GT(NumPointsOnBoard(), num_on_board / 2) << "the first keyframe is older";
  EXPECT_LT(NumObservationsOfBoardSince(second_ago_s), 0.25 * num_lately) << "all but those at the rim";
  EXPECT_THAT(FindBrokenInvariants(*map_.Read()), testing::IsEmpty());
  std::vector<int> before, lately;  // points on the board that a frame sees
  for (const PastFrame& frame : tracking_.ReviseRest())
    (frame.timestamp_s < second_ago_s ? before : lately).push_back(NumOnBoard(frame.sightings));
  ASSERT_FALSE(before.empty() || lately.empty());
  EXPECT_LT(std::ranges::max(lately), 0.3 * std::ranges::min(before));
}

TEST_F(MaskedTrackingTest, PointsOnWhatIsGoneAreErasedAndOthersStay) {
  ShowThatSomethingMoves();
  for (int i = 0; i < 3; ++i) Show(100, {});
  const int num_on_board = NumPointsOnBoard(), num_points = map_.Read()->num_points();
  ASSERT_GT(num_on_board, 50);
  for (int i = 0; i < 6; ++i) Show(kNoBoard, {});
  EXPECT_EQ(NumPointsOnBoard(), 0);
  EXPECT_GE(map_.Read()->num_points(), num_points - num_on_board);
  EXPECT_THAT(FindBrokenInvariants(*map_.Read()), testing::IsEmpty());
}

TEST_F(MaskedTrackingTest, WhereNothingHasEverMovedAndWithoutMasksNothingIsTakenForGone) {
  for (const bool asks : {true, false}) {
    const auto show = [&](int board_u) { asks ? Show(board_u, {}) : tracking_.Process(Image(board_u)); };
    show(100);
    const int num_on_board = NumPointsOnBoard();
    ASSERT_GT(num_on_board, 50);
    for (int i = 0; i < 6; ++i) show(kNoBoard);
    EXPECT_EQ(NumPointsOnBoard(), num_on_board) << asks;
  }
}

/// The mask leaves the keypoints' number as it is: others are found off it, and wait for points.
TEST_F(MaskedTrackingTest, WhereManyPointsAreErasedAKeyFrameSoonMakesOthers) {
  const cv::Mat most = Mask({size_.width / 4, 0, 3 * size_.width / 4, size_.height});
  for (int i = 0; i < 3; ++i) Show(kNoBoard, {});
  int num_keyframes = 0;
  for (int i = 0; i < 10; ++i) num_keyframes += Show(kNoBoard, most).new_keyframe.has_value();
  EXPECT_EQ(num_keyframes, 1);
  EXPECT_GT(Show(kNoBoard, most).num_matches, 700);
}

/// Depth may have been taken somewhat earlier or later.
TEST_F(MaskedTrackingTest, WhileThePictureShiftsFastNothingIsTakenForGone) {
  constexpr int kShiftPx = 12;
  ShowThatSomethingMoves();
  Show(100, {});
  const int num_on_board = NumPointsOnBoard();
  ASSERT_GT(num_on_board, 50);
  for (int i = 1; i < 6; ++i) {
    shifted_px_ = kShiftPx * i;
    ASSERT_EQ(Show(kNoBoard, {}).state, TrackingState::kOk);
    ASSERT_GE(NumPointsOnBoard(), num_on_board);
  }
  for (int i = 0; i < 6; ++i) Show(kNoBoard, {});
  EXPECT_LT(NumPointsOnBoard(), 0.2 * num_on_board) << "it stands still again";
}

TEST_F(MaskedTrackingTest, InLocalizationModeNothingIsErased) {
  for (int i = 0; i < 3; ++i) Show(100, {});
  const int num_points = map_.Read()->num_points();
  tracking_.SetLocalizationMode(true);
  for (int i = 0; i < 6; ++i) ShowMasked(100);
  for (int i = 0; i < 6; ++i) Show(kNoBoard, {});
  EXPECT_EQ(map_.Read()->num_points(), num_points);
  tracking_.SetLocalizationMode(false);
  Show(kNoBoard, {});
  EXPECT_GE(map_.Read()->num_points(), num_points) << "what was seen in the meantime does not count";
}

TEST_F(MaskedTrackingTest, AMaskThatLeavesTooLittleIsNotUsedAndSaysSo) {
  Show(100, {});
  for (int i = 1; i < 60; ++i) {  // more than the longest time between keyframes
    const FrameReport report = Show(100, cv::Mat(size_, CV_8UC1, cv::Scalar(255)));
    ASSERT_EQ(report.state, TrackingState::kOk);
    EXPECT_THAT(report.moving.fail_open_reason, testing::HasSubstr("leaves only 0 keypoints"));
    EXPECT_TRUE(report.moving.mask.empty());
    EXPECT_EQ(report.num_dropped_keypoints, 0);
    EXPECT_FALSE(report.new_keyframe);
  }
}

/// Three quarters of the wall come into view at once.
TEST_F(MaskedTrackingTest, WhereWhatMovedMayBeUnseenNoKeyFrameIsMadeForAWhile) {
  const cv::Mat most = Mask({size_.width / 4, 0, 3 * size_.width / 4, size_.height});
  for (int i = 0; i < 5; ++i) Show(100, most);
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(Show(100, {}, "nobody can tell").new_keyframe);
  int num_waited = 0;
  while (num_waited < 100 && !Show(100, {}, "nobody can tell").new_keyframe) ++num_waited;
  EXPECT_LE(num_waited, 35) << "it must not go on for ever";
}

TEST_F(MaskedTrackingTest, WhereTheDetectorKnowsItIsMadeAtOnce) {
  const cv::Mat most = Mask({size_.width / 4, 0, 3 * size_.width / 4, size_.height});
  for (int i = 0; i < 5; ++i) Show(100, most);
  EXPECT_TRUE(Show(100, {}).new_keyframe);
}

TEST_F(MaskedTrackingTest, AMaskThatIsLateButThereIsNoDoubt) {
  const cv::Mat most = Mask({size_.width / 4, 0, 3 * size_.width / 4, size_.height});
  for (int i = 0; i < 5; ++i) Show(100, most);
  EXPECT_TRUE(Show(100, Mask(BoardAt(100)), "the mask is late").new_keyframe);
}

TEST_F(MaskedTrackingTest, TheMaskIsAskedForOnceAFrameWithThePredictedMotion) {
  int num_asked = 0;
  for (int i = 0; i < 5; ++i) {
    tracking_.Process(Image(100), {}, [&](const Rigid3d& now_from_last) {
      ++num_asked;
      EXPECT_THAT(now_from_last, Rigid3dNear(Rigid3d(), 0.005, 0.005));
      return DynamicMask();
    });
  }
  EXPECT_EQ(num_asked, 5);
}

}  // namespace
}  // namespace orbslam::test
