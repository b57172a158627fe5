// SPDX-License-Identifier: GPL-3.0-or-later
#include "far_motion.h"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>

#include "rendered_room.h"
#include "tracked_corner.h"

namespace orbslam {
namespace {

using test::RenderedRoom;
using test::RoomBox;

/// The room with a box before it, now and half a second ago, and the corners followed in between.
class FarMotionTest : public testing::Test {
 protected:
  std::shared_ptr<const WorkingFrame> Frame(uint32_t id, const Rigid3d& pose, const RoomBox& box) const {
    return std::make_shared<const WorkingFrame>(reducer_.Reduce(room_.Render(id, pose, {box})));
  }

  void See(const RoomBox& before, const RoomBox& now) {
    earlier_.frame = Frame(0, {}, before);
    earlier_.envelope_m = MakeEnvelope(earlier_.frame->depth_m);
    earlier_.moving = cv::Mat1b(earlier_.frame->depth_m.size(), uint8_t{0});
    current_ = Frame(1, Inverse(truth_), now);
    matches_ = RestingMatches(
        grids_.gray, FollowCorners(grids_, earlier_, *current_, truth_, Baseline::kLong, FlowOptions()));
  }

  /// Beginning with what a camera that went along with the box would have seen.
  FarQuery Query() const {
    const Rigid3d bent{So3Exp({0, 0.02, 0}) * truth_.rotation,
                       truth_.translation + Eigen::Vector3d(0.07, 0, 0)};
    return {earlier_, *current_, matches_, {bent}, {}};
  }
  std::optional<FarMotion> Contradicted() const {
    Rng rng(1);
    return ContradictedFarMotion(grids_, Query(), {}, &rng);
  }
  void ExpectTrue(const Rigid3d& current_from_earlier) const {
    EXPECT_LT((current_from_earlier.translation - truth_.translation).norm(), 0.006);
    EXPECT_LT(AngularDistance(current_from_earlier.rotation, truth_.rotation), 0.002);
  }

  const Rigid3d truth_{So3Exp({0.01, -0.02, 0.01}), {0.02, 0.01, -0.01}};  // current_from_earlier
  RenderedRoom room_;
  FrameReducer reducer_{room_.camera};
  WorkingGrids grids_ = reducer_.grids();
  ReferenceView earlier_;
  std::shared_ptr<const WorkingFrame> current_;
  std::vector<CornerMatch> matches_;
};

const Eigen::Vector3d kBoxSize(0.3, 0.45, 0.1);

TEST_F(FarMotionTest, IsNotAskedForWhereAllRests) {
  const RoomBox box{{0.1, 0.1, 1.3}, kBoxSize};
  See(box, box);
  EXPECT_FALSE(Contradicted());
}

TEST_F(FarMotionTest, IsFoundWhereWhatIsNearHasGone) {
  See({{0.1, 0.1, 1.3}, kBoxSize}, {{0.15, 0.1, 1.3}, kBoxSize});
  const auto motion = Contradicted();
  ASSERT_TRUE(motion);
  ExpectTrue(motion->color_current_from_earlier);
  ExpectTrue(motion->depth_current_from_earlier);
  EXPECT_GT(motion->split_m, 1.2);
  EXPECT_LT(motion->split_m, 3.5);
}

TEST_F(FarMotionTest, AThingThatGoesLessThanErrorsAreIsNoContradiction) {
  See({{0.1, 0.1, 1.3}, kBoxSize}, {{0.102, 0.1, 1.3}, kBoxSize});
  EXPECT_FALSE(Contradicted());
}

TEST_F(FarMotionTest, WhatIsFarMayNotBeOutvoted) {
  const Eigen::Vector3d wide(2, 0.55, 0.1);
  See({{0, 0.15, 1.3}, wide}, {{0.05, 0.15, 1.3}, wide});
  ASSERT_GT(matches_.size(), 60u);
  EXPECT_FALSE(Contradicted());
}

TEST_F(FarMotionTest, WhatIsFarIsOnlyBelievedIfItIsOne) {
  See({{0.1, 0.1, 1.3}, kBoxSize}, {{0.15, 0.1, 1.3}, kBoxSize});
  int num_far = 0;
  for (CornerMatch& match : matches_)
    if (match.x_previous.z() > 1.9f && ++num_far % 2 == 0)
      match.pixel.y() += static_cast<float>(3 + num_far % 5);
  ASSERT_GT(num_far, 80);
  EXPECT_FALSE(Contradicted());
}

TEST_F(FarMotionTest, NeedsDepthThatFits) {
  See({{0.1, 0.1, 1.3}, kBoxSize}, {{0.15, 0.1, 1.3}, kBoxSize});
  auto without_depth = std::make_shared<WorkingFrame>(*current_);
  without_depth->depth_m = cv::Mat1f::zeros(current_->depth_m.size());
  current_ = without_depth;
  EXPECT_FALSE(Contradicted());
}

TEST_F(FarMotionTest, TooFewMatchesTellNothing) {
  See({{0.1, 0.1, 1.3}, kBoxSize}, {{0.15, 0.1, 1.3}, kBoxSize});
  for (const size_t count : {0u, 1u, 10u, 30u}) {
    matches_.resize(count);
    EXPECT_FALSE(Contradicted());
  }
}

TEST_F(FarMotionTest, HangsOnNothingThatIsNear) {
  See({{0.1, 0.1, 1.3}, kBoxSize}, {{0.25, 0, 1.2}, kBoxSize});
  Rng rng(1);
  const auto motion = FindFarMotion(grids_, Query(), 1.9, {}, &rng);
  ASSERT_TRUE(motion);
  ExpectTrue(motion->color_current_from_earlier);
  ExpectTrue(motion->depth_current_from_earlier);
}

/// Corners of a small flat patch cannot tell a turn from a shift.
TEST_F(FarMotionTest, APriorTellsWhatCornersLeaveOpen) {
  std::vector<CornerMatch> patch;
  Rng rng(5);
  for (int i = 0; i < 30; ++i) {
    CornerMatch match{{0.01f * static_cast<float>(i % 6), 0.01f * static_cast<float>(i / 6), 3.f}, {}};
    match.pixel = -ErrorPx(grids_.gray, truth_, match).cast<float>();
    match.pixel.x() += static_cast<float>(0.1 * rng.Gaussian());
    patch.push_back(match);
  }
  PoseFromCornersOptions options;
  options.num_draws = 0;
  const Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity() * 1e8;
  const PosePrior prior{truth_, information};
  const PoseFromCorners found = EstimatePose(grids_.gray, patch, {truth_}, options, &rng, &prior);
  EXPECT_LT((found.current_from_previous.translation - truth_.translation).norm(), 5e-4);
  EXPECT_LT(AngularDistance(found.current_from_previous.rotation, truth_.rotation), 5e-4);
  const Eigen::Matrix<double, 6, 6> gained = found.information - information;
  EXPECT_GT((gained + 10 * Eigen::Matrix<double, 6, 6>::Identity()).eigenvalues().real().minCoeff(), 0);
}

}  // namespace
}  // namespace orbslam
