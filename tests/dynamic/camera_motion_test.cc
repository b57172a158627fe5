// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera_motion.h"

#include <gmock/gmock.h>

#include "rendered_room.h"
#include "segmenter.h"

namespace orbslam {
namespace {

using test::RenderedRoom;
using test::RoomBox;
using test::Sway;

struct Pair {
  CameraMotion motion;
  Rigid3d truth;  // current_from_previous
};

/// The motion from one rendered frame to the next, after eight frames of history with true poses.
Pair Estimate(const std::function<std::vector<RoomBox>(uint32_t)>& movers,
              const CameraMotionOptions& options = {}) {
  constexpr uint32_t kLast = 9;
  const RenderedRoom room;
  const FrameReducer reducer(room.camera);
  SceneHistory history(reducer.grids().cell, {}, 0);
  CameraMotionEstimator estimator(reducer.grids(), options);
  for (uint32_t frame = 0; frame < kLast; ++frame) {
    const Rigid3d motion = Inverse(Sway(frame == 0 ? 0 : frame - 1)) * Sway(frame);
    if (frame > 0) history.Advance(motion, motion);
    auto working =
        std::make_shared<const WorkingFrame>(reducer.Reduce(room.Render(frame, Sway(frame), movers(frame))));
    history.Add(working, cv::Mat1b(working->depth_m.size(), uint8_t{0}), nullptr);
  }
  const WorkingFrame last = reducer.Reduce(room.Render(kLast, Sway(kLast), movers(kLast)));
  return {estimator.Estimate(history, last, 1), Inverse(Sway(kLast)) * Sway(kLast - 1)};
}

void ExpectNear(const Rigid3d& a, const Rigid3d& b) {
  EXPECT_LT((a.translation - b.translation).norm(), 0.004);
  EXPECT_LT(AngularDistance(a.rotation, b.rotation), 0.003);
}

TEST(CameraMotion, IsRecoveredInARestingRoom) {
  const Pair pair = Estimate([](uint32_t) { return std::vector<RoomBox>{}; });
  EXPECT_EQ(pair.motion.failure, "");
  ExpectNear(pair.motion.color_current_from_previous, pair.truth);
  ExpectNear(pair.motion.depth_current_from_previous, pair.truth);
}

TEST(CameraMotion, IsRecoveredThoughSomethingNearMoves) {
  const Pair pair = Estimate([](uint32_t frame) {
    return std::vector<RoomBox>{{{-0.4 + 0.03 * frame, 0, 1.8}, {0.25, 0.6, 0.1}}};
  });
  ExpectNear(pair.motion.depth_current_from_previous, pair.truth);
  int num_moving = 0;
  for (const TrackedCorner& corner : pair.motion.corners) num_moving += corner.residual_px > 3;
  EXPECT_GT(num_moving, 10);
}

TEST(CameraMotion, TooFewCornersDoWhereTheyConfirmTheDepths) {
  const auto nobody = [](uint32_t) { return std::vector<RoomBox>{}; };
  CameraMotionOptions options;
  options.pose.min_inliers = 1000;
  const Pair few = Estimate(nobody, options);
  EXPECT_EQ(few.motion.failure, "");
  ExpectNear(few.motion.color_current_from_previous, few.truth);
  options.min_inliers_with_depth = 1000;
  EXPECT_EQ(Estimate(nobody, options).motion.failure, "too few corners could be followed");
}

TEST(Segmenter, SplitsAtDepthEdgesAndLeavesOutWhatIsExcluded) {
  cv::Mat1f depth(120, 160, 3.f);
  depth(cv::Rect(20, 20, 40, 60)).setTo(1.5f);
  cv::Mat1b included(depth.size(), uint8_t{255});
  EXPECT_EQ(SegmentCells(depth, included, 20).clusters.size(), 2u);
  included(cv::Rect(0, 0, 160, 15)).setTo(0);
  included(cv::Rect(0, 15, 15, 105)).setTo(0);
  const Segmentation segmentation = SegmentCells(depth, included, 20);
  EXPECT_EQ(segmentation.labels(5, 5), -1);
  EXPECT_NE(segmentation.labels(30, 30), segmentation.labels(100, 100));
  EXPECT_TRUE(SegmentCells(depth, included, 100000).clusters.empty());
}

TEST(WorkingFrame, MasksComeBackToTheirRawPixelsThroughDistortion) {
  PinholeCamera camera{640, 480, 517, 516, 318, 255, {0.26, -0.95, -0.005, 0.003, 1.16}};
  const FrameReducer reducer(camera);
  RgbdImage image;
  image.gray = cv::Mat1b(480, 640, uint8_t{0});
  image.depth_m = cv::Mat1f(480, 640, 3.f);
  const cv::Rect thing(100, 60, 120, 200);
  cv::Mat1f(image.depth_m)(thing).setTo(1.f);
  const WorkingFrame frame = reducer.Reduce(image);
  cv::Mat1b near;
  cv::inRange(frame.depth_m, 0.1, 2, near);
  const cv::Mat1b raw = reducer.ToRawMask(near);
  cv::Mat1b truth(480, 640, uint8_t{0});
  truth(thing).setTo(255);
  const double both = cv::countNonZero(raw & truth), either = cv::countNonZero(raw | truth);
  EXPECT_GT(both / either, 0.93);
}

}  // namespace
}  // namespace orbslam
