// SPDX-License-Identifier: GPL-3.0-or-later
#include "whole_things.h"

#include <gtest/gtest.h>

#include <memory>
#include <opencv2/imgproc.hpp>

#include "depth_scene.h"

namespace orbslam::test {
namespace {

const cv::Size kCells(kCellCamera.width, kCellCamera.height);

cv::Mat1b Nothing() { return {kCells, uint8_t{0}}; }

cv::Mat1b NearerThan(const WorkingFrame& frame, float depth_m) {
  cv::Mat1b nearer;
  cv::inRange(frame.depth_m, 0.1, depth_m, nearer);
  return nearer;
}

/// A post like a trunk stands on a floor. Its left side moves.
struct PostThatMoves {
  WorkingFrame frame = See([](float x, float y) { return PostOnFloor(x, y, 0.15f); });
  cv::Mat1b post = Nothing(), moving = Nothing();

  explicit PostThatMoves(int num_columns) {
    const WorkingFrame floor = See([](float, float y) { return Floor(y); });
    for (int i = 0; i < static_cast<int>(post.total()); ++i)
      post(i) = frame.depth_m(i) > 0 && std::abs(frame.depth_m(i) - floor.depth_m(i)) > 0.05f ? 255 : 0;
    const cv::Rect box = cv::boundingRect(post);
    post(cv::Rect(box.x, 0, num_columns, kCells.height)).copyTo(moving.colRange(box.x, box.x + num_columns));
  }
};

TEST(WholeThings, WhatIsJoinedToAMovingPartMovesAndTheFloorDoesNot) {
  const PostThatMoves scene(20);
  const cv::Mat1b found = WholeThings(kCellCamera, scene.frame, scene.moving, Nothing(), {});
  const double rest = cv::countNonZero(scene.post) - cv::countNonZero(scene.moving);
  EXPECT_GT(cv::countNonZero(found & scene.post), 0.9 * rest);
  cv::Mat1b about_post;
  cv::dilate(scene.post, about_post,
             cv::Mat::ones(13, 13, CV_8U));  // its foot, too, is off the floor by little
  EXPECT_EQ(cv::countNonZero(found & ~about_post), 0);
  EXPECT_EQ(cv::countNonZero(found & scene.moving), 0);
}

/// The trunk leans against a wall: one piece with it, once the floor is gone.
TEST(WholeThings, OnePlaneAfterTheOtherIsTakenAway) {
  const auto wall = [](float y) { return 1.2f * std::sqrt(2.f) / (1 - y); };
  const WorkingFrame frame = See([&](float x, float y) {
    const float front = PostOnFloor(x, y, 0.15f);
    return front > 0 ? std::min(front, wall(y)) : wall(y);
  });
  const PostThatMoves alone(20);
  const cv::Mat1b found = WholeThings(kCellCamera, frame, alone.moving, Nothing(), {});
  EXPECT_GT(cv::countNonZero(found & alone.post), 300);
  cv::Mat1b about_post;
  cv::dilate(alone.post, about_post, cv::Mat::ones(13, 13, CV_8U));
  EXPECT_EQ(cv::countNonZero(found & ~about_post), 0);
}

TEST(WholeThings, ALittleThatMovesTellsNothingOfTheRest) {
  const auto num_found = [](const PostThatMoves& scene, const WholeThingOptions& options) {
    return cv::countNonZero(WholeThings(kCellCamera, scene.frame, scene.moving, Nothing(), options));
  };
  const PostThatMoves scene(20);
  const int num_moving = cv::countNonZero(scene.moving);
  const float share = static_cast<float>(num_moving) / static_cast<float>(cv::countNonZero(scene.post));
  EXPECT_GT(num_found(scene, {.min_moving_cells = num_moving - 1}), 0);
  EXPECT_EQ(num_found(scene, {.min_moving_cells = num_moving + 1}), 0);
  EXPECT_GT(num_found(scene, {.min_moving_share = share - 0.1f}), 0);
  EXPECT_EQ(num_found(scene, {.min_moving_share = share + 0.1f}), 0);
}

TEST(WholeThings, WhatIsRootedIsNoPartOfThem) {
  const PostThatMoves scene(20);
  cv::Mat1b rooted = Nothing();
  rooted.rowRange(0, 40).setTo(255);
  const cv::Mat1b found = WholeThings(kCellCamera, scene.frame, scene.moving, rooted, {});
  EXPECT_EQ(cv::countNonZero(found.rowRange(0, 40)), 0);
  EXPECT_GT(cv::countNonZero(found.rowRange(41, kCells.height)), 100);
}

/// Hands before somebody's chest, but in front of it.
TEST(WholeThings, ThingsEndWhereDepthJumps) {
  const auto hand_before = [](float gap_m) {
    const WorkingFrame frame = See([gap_m](float x, float y) {
      const float r2 = x * x + y * y;
      if (r2 < 0.01f) return 1.f;
      return r2 < 0.06f ? 1 + gap_m + 2 * (r2 - 0.01f) : 0.f;  // round, so that it is no furniture
    });
    const cv::Mat1b hand = NearerThan(frame, 1.001f);
    return cv::countNonZero(WholeThings(kCellCamera, frame, hand, Nothing(), {}));
  };
  EXPECT_GT(hand_before(0.01f), 2000);
  EXPECT_EQ(hand_before(0.2f), 0);
}

TEST(WholeThings, ReachAsFarAsAPersonDoes) {
  const WorkingFrame rail = See([](float x, float y) {
    return std::abs(y) < 0.08f && x > -0.55f ? 2 + 0.1f * std::sin(20 * x) : 0.f;  // 2.3 m long
  });
  cv::Mat1b moving = Nothing();
  rail.depth_m.colRange(0, 30).copyTo(moving.colRange(0, 30));
  moving = moving > 0;
  const cv::Mat1b found = WholeThings(kCellCamera, rail, moving, Nothing(), {});
  const cv::Rect reached = cv::boundingRect(found);
  EXPECT_NEAR(static_cast<float>(reached.br().x - 30) * 2 / kCellCamera.fx, 1, 0.1);
}

class RootedCellsTest : public testing::Test {
 protected:
  /// A wall so far away that long, seen that many frames ago.
  const ReferenceView* Saw(float depth_m, int age_frames, uint8_t moving = 0) {
    auto frame = std::make_shared<WorkingFrame>();
    frame->depth_m = cv::Mat1f(kCells, depth_m);
    auto view = std::make_unique<ReferenceView>();
    view->envelope_m = MakeEnvelope(frame->depth_m);
    view->moving = cv::Mat1b(kCells, moving);
    view->frame = std::move(frame);
    view->age_frames = age_frames;
    views_.push_back(std::move(view));
    return views_.back().get();
  }

  static bool IsRooted(const std::vector<const ReferenceView*>& views) {
    // At the corners fewer than six of nine neighbours are measured.
    const SightingRules rules = RootedRules({});
    const int count = cv::countNonZero(
        RootedCells(CountSightings(kCellCamera, cv::Mat1f(kCells, 1.5f), views, {&rules, 1}).front()));
    EXPECT_TRUE(count == 0 || count > kCells.area() - 10) << count;
    return count > 0;
  }

  std::vector<std::unique_ptr<ReferenceView>> views_;
};

TEST_F(RootedCellsTest, AreThoseThatStoodThereExactlyForLong) {
  EXPECT_TRUE(IsRooted({Saw(1.5f, 20)}));
  EXPECT_TRUE(IsRooted({Saw(1.505f, 200)}));
  EXPECT_FALSE(IsRooted({}));
  EXPECT_FALSE(IsRooted({Saw(1.5f, 14)}));  // who sways has not moved either
  EXPECT_FALSE(IsRooted({Saw(1.53f, 20)}));
  EXPECT_FALSE(IsRooted({Saw(1.47f, 20)}));
  EXPECT_FALSE(IsRooted({Saw(1.5f, 20, 255)}));  // there, but in the mask
}

TEST_F(RootedCellsTest, AreDecidedByTwoThirdsOfThoseThatCanTell) {
  const auto *there = Saw(1.5f, 20), *there_too = Saw(1.5f, 40), *through = Saw(2.f, 60);
  EXPECT_TRUE(IsRooted({there, there_too, through}));
  EXPECT_FALSE(IsRooted({there, through}));
}

}  // namespace
}  // namespace orbslam::test
