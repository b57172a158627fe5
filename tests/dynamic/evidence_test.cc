// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence.h"

#include <gmock/gmock.h>

namespace orbslam {
namespace {

/// A solid cluster of 200 cells of which everything is judged and half is suspicious.
ClusterFacts Mover() {
  ClusterFacts facts;
  facts.num_cells = facts.num_judged = 200;
  facts.num_suspicious = 100, facts.num_interior = 140, facts.num_border = 60;
  return facts;
}

float Fuse(const ClusterFacts& facts, const FusionOptions& options = {}) {
  return FuseEvidence(MakeEvidence(options), facts, options);
}

TEST(Evidence, WhatStandsInFreeSpaceMoves) {
  ClusterFacts facts = Mover();
  EXPECT_GT(Fuse(facts), 0);
  facts.num_suspicious = 5;
  EXPECT_LT(Fuse(facts), 0);
}

TEST(Evidence, WhatNobodyJudgesHasThePrior) {
  ClusterFacts facts = Mover();
  facts.num_judged = facts.num_suspicious = 0;
  EXPECT_FLOAT_EQ(Fuse(facts), FusionOptions().prior);
}

TEST(Evidence, MoreOfItNeverSpeaksTheOtherWay) {
  for (int suspicious = 0; suspicious < 200; suspicious += 10) {
    ClusterFacts less = Mover(), more = Mover();
    less.num_suspicious = suspicious, more.num_suspicious = suspicious + 10;
    EXPECT_LE(Fuse(less), Fuse(more));
  }
  ClusterFacts carried = Mover(), corners = Mover();
  carried.carried = 2, corners.num_corners = corners.num_moving_corners = 4;
  EXPECT_GT(Fuse(carried), Fuse(Mover()));
  EXPECT_GT(Fuse(corners), Fuse(Mover()));
}

/// Two things side by side, the left of which moved before; on each a corner that moves and one that rests,
/// followed from an older frame.
std::vector<ClusterFacts> FactsFromOlderFrame(float sharpness, bool left_is_flat = false) {
  const cv::Rect left(0, 0, 20, 20), right(20, 0, 20, 20);
  Segmentation segmentation{cv::Mat1i(20, 40, 0), std::vector<Cluster>(2)};
  segmentation.labels(right).setTo(1);
  for (int cell = 0; cell < 20 * 40; ++cell)
    segmentation.clusters[segmentation.labels(cell)].cells.push_back(cell);
  segmentation.clusters[0].is_flat = left_is_flat;
  WorkingFrame frame;
  frame.depth_m = cv::Mat1f(20, 40, 2.f);
  cv::Mat1f carried(20, 40, -1.f);
  carried(left).setTo(2);
  const cv::Mat1b none(20, 40, uint8_t{0});
  Flow last{{}, {0.5f, 1}}, older{{}, {1, sharpness}};
  for (const float x : {20.f, 60.f})  // grey px, two a cell
    for (const float residual_px : {3.f, 0.f}) {
      TrackedCorner& corner = older.corners.emplace_back();
      corner.current = {x, 20}, corner.residual_px = residual_px;
    }
  const std::vector<Flow> flows{last, older};
  return GatherFacts(segmentation, frame, {none, none, none, none}, carried, flows);
}

TEST(Evidence, AnOlderFrameThatIsNotSharpHoldsWhatMovesButBeginsNothing) {
  const std::vector<ClusterFacts> sharp = FactsFromOlderFrame(1), blurred = FactsFromOlderFrame(0.6f);
  for (const ClusterFacts& facts : sharp) {
    EXPECT_EQ(facts.num_corners, 2);
    EXPECT_EQ(facts.num_moving_corners, 1);
  }
  EXPECT_EQ(blurred[0].num_corners, 1);
  EXPECT_EQ(blurred[0].num_moving_corners, 1);
  EXPECT_EQ(blurred[1].num_corners, 0);
}

TEST(Evidence, AFloorMovesNeitherByItsPastNorByTheShoesOnIt) {
  const std::vector<ClusterFacts> thing = FactsFromOlderFrame(1), floor = FactsFromOlderFrame(1, true);
  EXPECT_GT(thing[0].carried, 1);
  EXPECT_EQ(floor[0].carried, 0);
  EXPECT_EQ(floor[0].num_corners, 0);
  EXPECT_EQ(floor[0].num_moving_corners, 0);
  EXPECT_EQ(floor[1].num_corners, thing[1].num_corners);  // what is beside it is judged as ever
  EXPECT_EQ(floor[1].carried, thing[1].carried);
}

/// A cell is inside a cluster if all eight around it are of it.
TEST(Evidence, ACellAtACornerOfItsClusterIsNotInside) {
  const cv::Size size(9, 7);
  const cv::Mat1b none(size, uint8_t{0});
  WorkingFrame frame;
  frame.depth_m = cv::Mat1f(size, 2.f);
  for (const cv::Point corner : {cv::Point(-1, -1), {1, -1}, {-1, 1}, {1, 1}, {9, 9}}) {
    Segmentation segmentation{cv::Mat1i(size, -1), std::vector<Cluster>(1)};
    for (int v = 2; v <= 4; ++v)
      for (int u = 3; u <= 5; ++u) {
        if (cv::Point(u, v) == cv::Point(4, 3) + corner) continue;
        segmentation.labels(v, u) = 0;
        segmentation.clusters[0].cells.push_back(v * size.width + u);
      }
    const std::vector<Flow> flows{{{}, {0.5f, 1}}};
    const ClusterFacts facts =
        GatherFacts(segmentation, frame, {none, none, none, none}, cv::Mat1f(size, 0.f), flows).front();
    EXPECT_EQ(facts.num_interior, corner.x == 9 ? 1 : 0) << corner;
    EXPECT_EQ(facts.num_border, facts.num_cells - 1) << corner;
  }
}

TEST(Evidence, CornersWeighByHowExactTheyAre) {
  ClusterFacts facts = Mover();
  facts.num_judged = facts.num_suspicious = 0, facts.num_corners = facts.num_moving_corners = 40;
  float last = FusionOptions().prior;
  for (const float sharpness : {0.4f, 0.6f, 1.f}) {
    facts.sharpness = sharpness;
    EXPECT_GT(Fuse(facts), last);
    last = Fuse(facts);
  }
  EXPECT_FLOAT_EQ(last, FusionOptions().prior + FusionOptions().max_corner);
}

TEST(Evidence, WhoPausesIsNotForgottenForHisRestingCorners) {
  ClusterFacts facts = Mover();
  facts.num_judged = facts.num_suspicious = 0, facts.num_corners = 1000;
  EXPECT_FLOAT_EQ(Fuse(facts), FusionOptions().prior - FusionOptions().max_resting);
}

TEST(Evidence, EdgesOfStaticThingsAreDoubted) {
  ClusterFacts thin = Mover(), attached = Mover();
  thin.num_interior = 0, attached.num_attached = attached.num_border;
  EXPECT_LT(Fuse(thin), Fuse(Mover()));
  EXPECT_LT(Fuse(attached), Fuse(Mover()));
}

TEST(Evidence, EachSwitchTakesItsSourceAway) {
  ClusterFacts facts = Mover();
  facts.carried = 2, facts.num_corners = facts.num_moving_corners = 4;
  facts.num_interior = 0, facts.num_attached = facts.num_border;
  for (bool FusionOptions::*on :
       {&FusionOptions::use_free_space, &FusionOptions::use_carry, &FusionOptions::use_klt_residual,
        &FusionOptions::use_attachment, &FusionOptions::use_thickness}) {
    FusionOptions options;
    options.*on = false;
    EXPECT_EQ(MakeEvidence(options).size() + 1, MakeEvidence({}).size());
    EXPECT_NE(Fuse(facts, options), Fuse(facts));
  }
}

TEST(Evidence, TheLineIntegralIsNeutralAtTauAndBounded) {
  const FusionOptions options;
  EXPECT_FLOAT_EQ(HistogramLogOdds(1, options), 0);
  EXPECT_GT(HistogramLogOdds(2, options), 0);
  EXPECT_LE(HistogramLogOdds(1000, options), options.max_histogram);
}

}  // namespace
}  // namespace orbslam
