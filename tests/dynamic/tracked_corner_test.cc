// SPDX-License-Identifier: GPL-3.0-or-later
#include "tracked_corner.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "camera_motion.h"
#include "rendered_room.h"

namespace orbslam {
namespace {

using test::RenderedRoom;
using test::RoomBox;

/// A view of the room half a second ago, and what the camera sees now that it has moved.
class TrackedCornerTest : public testing::Test {
 protected:
  ReferenceView View(const Rigid3d& world_from_camera, const std::vector<RoomBox>& boxes,
                     const Rigid3d& world_from_current) const {
    ReferenceView view;
    view.frame = Frame(0, world_from_camera, boxes);
    view.envelope_m = MakeEnvelope(view.frame->depth_m);
    view.moving = cv::Mat1b(view.frame->depth_m.size(), uint8_t{0});
    view.reference_from_current = view.color_reference_from_current =
        Inverse(world_from_camera) * world_from_current;
    return view;
  }

  std::shared_ptr<const WorkingFrame> Frame(uint32_t id, const Rigid3d& world_from_camera,
                                            const std::vector<RoomBox>& boxes) const {
    return std::make_shared<const WorkingFrame>(reducer_.Reduce(room_.Render(id, world_from_camera, boxes)));
  }

  /// Of the corners followed from a view along the true motion: the median distance from where they should
  /// be.
  double MedianResidualPx(const Rigid3d& world_from_current, Baseline baseline) const {
    const ReferenceView view = View({}, {}, world_from_current);
    const Rigid3d motion = Inverse(view.reference_from_current);
    auto corners =
        FollowCorners(grids_, view, *Frame(1, world_from_current, {}), motion, baseline, FlowOptions());
    MeasureExcess(grids_.gray, motion, &corners);
    return RestingResidualPx(corners, 0.5, 100).value_or(1e9f);
  }

  RenderedRoom room_;
  FrameReducer reducer_{room_.camera};
  WorkingGrids grids_ = reducer_.grids();
};

TEST_F(TrackedCornerTest, PatchesAreFollowedThroughAShift) {
  const auto frame = Frame(0, {}, {});
  std::vector<cv::Mat1f> shifted;
  for (int level = 0; level < 3; ++level) {  // to the left by 4, 2 and 1 px
    cv::Mat1f image = frame->pyramid[level].clone();
    const int shift = 4 >> level;
    frame->pyramid[level].colRange(shift, image.cols).copyTo(image.colRange(0, image.cols - shift));
    shifted.push_back(image);
  }
  std::vector<FlowQuery> queries;
  for (const cv::Point2f& corner : frame->corners) queries.push_back({corner, corner, {}});
  ASSERT_GT(queries.size(), 100u);
  int num_right = 0;
  const auto flow = TrackPatches(frame->pyramid, shifted, queries, {});
  for (size_t i = 0; i < flow.size(); ++i)
    num_right += flow[i].ok && cv::norm(flow[i].position - queries[i].position - cv::Point2f(-4, 0)) < 0.1;
  EXPECT_GT(num_right, 0.8 * static_cast<double>(queries.size()));
}

TEST_F(TrackedCornerTest, PatchesThatAreToldNotToTurnAreFollowedAlike) {
  const auto before = Frame(0, {}, {}), now = Frame(1, {So3Exp({0, 0.005, 0}), {}}, {});
  std::vector<FlowQuery> plain, told;
  for (const cv::Point2f& corner : before->corners) {
    plain.push_back({corner, corner, {}});
    told.push_back({corner, corner, cv::Matx22f::eye()});
  }
  const auto a = TrackPatches(before->pyramid, now->pyramid, plain, {});
  const auto b = TrackPatches(before->pyramid, now->pyramid, told, {});
  int num_ok = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (!a[i].ok || !b[i].ok) continue;
    ++num_ok;
    EXPECT_LT(cv::norm(a[i].position - b[i].position), 0.01);
  }
  EXPECT_GT(num_ok, 100);
}

TEST_F(TrackedCornerTest, OverALongBaselinePatchesTurnWithTheCamera) {
  const Rigid3d rolled(So3Exp({0, 0, 0.15}), {});
  EXPECT_LT(MedianResidualPx(rolled, Baseline::kLong), 0.1);
  EXPECT_GT(MedianResidualPx(rolled, Baseline::kShort), 2 * MedianResidualPx(rolled, Baseline::kLong));
}

TEST_F(TrackedCornerTest, OverALongBaselinePatchesGrowWithWhatComesNearer) {
  const Rigid3d nearer({}, {0, 0, 0.4});
  EXPECT_LT(MedianResidualPx(nearer, Baseline::kLong), MedianResidualPx(nearer, Baseline::kShort));
}

TEST_F(TrackedCornerTest, AtAnEdgeTheDepthLiesBetweenTheTwoSides) {
  const std::vector<RoomBox> boxes{{{0, 0, 1.5}, {0.3, 0.3, 0.05}}};  // its front 1.45 m away, the wall 3.5
  const ReferenceView view = View({}, boxes, {});
  auto corners = FollowCorners(grids_, view, *view.frame, {}, Baseline::kLong, FlowOptions());
  int num_on_edge = 0;
  for (const TrackedCorner& corner : corners) {
    const double from_middle =
        cv::norm(cv::Mat1f(cv::Point2f(corner.previous.x - 159.5f, corner.previous.y - 119.5f)),
                 cv::NORM_INF);  // the box's sides are 54 px from it
    EXPECT_TRUE(from_middle > 45 || corner.IsDepthKnown());
    if (corner.IsDepthKnown()) continue;
    EXPECT_LE(corner.nearest_m, corner.depth_m);
    EXPECT_GE(corner.farthest_m, corner.depth_m);
    num_on_edge += corner.nearest_m < 1.6 && corner.farthest_m > 3;
  }
  EXPECT_GT(num_on_edge, 3);
}

TEST_F(TrackedCornerTest, ExcessIsNothingWhereverBetweenItsDepthsACornerCanBe) {
  const Rigid3d motion({}, {-0.1, 0, 0});
  const auto flow_px = [&](float depth_m) { return -0.1f * grids_.gray.fx / depth_m; };
  TrackedCorner corner;
  corner.previous = {100, 80};
  corner.depth_m = corner.nearest_m = 1, corner.farthest_m = 3;
  std::vector<TrackedCorner> corners;
  for (const float depth_m : {0.8f, 1.f, 2.f, 3.f, 4.f}) {
    corner.current = corner.previous + cv::Point2f(flow_px(depth_m), 0);
    corners.push_back(corner);
  }
  MeasureExcess(grids_.gray, motion, &corners);
  EXPECT_NEAR(corners[0].excess.x, flow_px(0.8f) - flow_px(1), 1e-3);
  for (int i : {1, 2, 3}) EXPECT_NEAR(corners[i].residual_px, 0, 1e-3);
  EXPECT_NEAR(corners[4].excess.x, flow_px(4) - flow_px(3), 1e-3);
}

/// Somebody near has begun to walk, and depth went with him; colour, by little.
TEST_F(TrackedCornerTest, WhoDraggedTheMotionAlongPartsFromTheRoomOverALongBaseline) {
  const auto box = [](double x) { return std::vector<RoomBox>{{{x, 0.1, 1.3}, {0.35, 0.5, 0.1}}}; };
  const Rigid3d current(So3Exp({0, 0.02, 0.05}), {0.01, 0, 0});
  ReferenceView older = View({}, box(-0.1), current), last = View(current, box(-0.06), current);
  const Rigid3d truth = older.reference_from_current;
  older.reference_from_current.translation.x() -= 0.08;
  older.color_reference_from_current.translation.x() -= 0.002;
  const CameraMotionEstimator estimator(grids_, {});
  const OlderCorners found = estimator.FollowFrom(older, last, *Frame(1, current, box(-0.02)), 1);
  ASSERT_TRUE(found.current_from_older);
  EXPECT_LT((*found.current_from_older * truth).translation.norm(), 0.002);
  std::vector<float> of_room, of_box;
  for (const TrackedCorner& corner : found.corners)
    if (corner.IsDepthKnown()) (corner.depth_m < 1.6 ? of_box : of_room).push_back(corner.residual_px);
  ASSERT_GT(of_room.size(), 50u);
  ASSERT_GT(of_box.size(), 10u);
  std::sort(of_room.begin(), of_room.end()), std::sort(of_box.begin(), of_box.end());
  EXPECT_LT(of_room[of_room.size() * 3 / 4], 1);
  EXPECT_GT(of_box[of_box.size() / 4], 5);  // 8 cm at 1.2 m are 17 px
}

TEST_F(TrackedCornerTest, AThingThatFillsMostOfThePictureIsNotTakenForTheRoom) {
  const auto board = [](double x) { return std::vector<RoomBox>{{{x, 0.25, 1.3}, {2, 0.62, 0.1}}}; };
  const ReferenceView older = View({}, board(0), {});
  const CameraMotionEstimator estimator(grids_, {});
  const OlderCorners found = estimator.FollowFrom(older, older, *Frame(1, {}, board(0.03)), 1);
  ASSERT_TRUE(found.current_from_older);
  EXPECT_LT(found.current_from_older->translation.norm(), 0.003);
}

/// Who set off at once has bent what was carried by 10 px, and depth, less, by 2.
TEST_F(TrackedCornerTest, TheRoomIsFoundAgainWhereWhatIsCarriedIsBent) {
  const Rigid3d current(So3Exp({0, 0.01, 0}), {0.05, 0, 0});
  ReferenceView older = View({}, {}, current);
  const Rigid3d truth = older.reference_from_current;
  older.reference_from_current.translation.x() -= 0.025;
  older.color_reference_from_current.translation.x() -= 0.12;
  const CameraMotionEstimator estimator(grids_, {});
  const OlderCorners found = estimator.FollowFrom(older, older, *Frame(1, current, {}), 1);
  ASSERT_TRUE(found.current_from_older);
  EXPECT_LT((*found.current_from_older * truth).translation.norm(), 0.003);
}

TEST_F(TrackedCornerTest, WhatTheLastMaskCoversDoesNotTellOfTheMotion) {
  const ReferenceView older = View({}, {}, {});
  ReferenceView last = older;
  last.moving = last.moving.clone();
  last.moving(cv::Rect(0, 0, last.moving.cols / 2, last.moving.rows)).setTo(255);
  const CameraMotionEstimator estimator(grids_, {});
  const OlderCorners found = estimator.FollowFrom(older, last, *Frame(1, {}, {}), 1);
  ASSERT_GT(found.corners.size(), 100u);
  for (const TrackedCorner& corner : found.corners)
    EXPECT_EQ(corner.was_moving, CellOf(corner).x < last.moving.cols / 2);
}

TEST_F(TrackedCornerTest, PuttingOneColourPoseRightLeavesTheViewsAsTheyAreToEachOther) {
  SceneHistory history(grids_.cell, {}, 0);
  const auto frame = Frame(0, {}, {});
  const cv::Mat1b nothing(frame->depth_m.size(), uint8_t{0});
  const Rigid3d motion(So3Exp({0, 0.01, 0}), {0.02, 0, 0.01});
  for (int i = 0; i < 3; ++i) {
    history.Add(frame, nothing, nullptr);
    history.Advance({}, motion);
  }
  const auto between = [&] {
    return history.Back(3)->color_reference_from_current *
           Inverse(history.Back(1)->color_reference_from_current);
  };
  const Rigid3d before = between(), right(So3Exp({0.02, 0, 0}), {0.1, 0, 0});
  history.CorrectColor(*history.Back(3), right);
  EXPECT_LT((history.Back(3)->color_reference_from_current.translation - right.translation).norm(), 1e-12);
  EXPECT_LT((between().translation - before.translation).norm(), 1e-12);
  EXPECT_EQ(history.Back(3)->reference_from_current.translation.norm(), 0);  // depth has its own
  history.CorrectDepth(*history.Back(2), right);
  for (const int back : {1, 2, 3})
    EXPECT_LT((history.Back(back)->reference_from_current.translation - right.translation).norm(), 1e-12);
  EXPECT_LT((between().translation - before.translation).norm(), 1e-12);
}

}  // namespace
}  // namespace orbslam
