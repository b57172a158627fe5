// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_space.h"

#include <gmock/gmock.h>

#include <iterator>
#include <vector>

#include "background_view.h"
#include "orbslam/camera/depth_model.h"
#include "orbslam/util/random.h"
#include "scene_history.h"

namespace orbslam {
namespace {

constexpr GridCamera kCamera{160, 120, 130, 130, 79.5f, 59.5f};
const cv::Rect kThing(60, 40, 30, 30);

/// A wall at wall_m, and a thing before it at thing_m (0: none), with the sensor's noise.
cv::Mat1f Depth(float wall_m, float thing_m, uint64_t seed) {
  cv::Mat1f depth(kCamera.height, kCamera.width, wall_m);
  if (thing_m > 0) depth(kThing).setTo(thing_m);
  Rng rng(seed);
  for (float& z : depth) z += static_cast<float>(rng.Gaussian() * DepthModel::SigmaM(z));
  return depth;
}

ReferenceView Reference(const cv::Mat1f& depth) {
  auto frame = std::make_shared<WorkingFrame>();
  frame->depth_m = depth;
  ReferenceView view;
  view.frame = frame, view.envelope_m = MakeEnvelope(depth), view.moving = cv::Mat1b::zeros(depth.size());
  return view;
}

double Share(const cv::Mat& image, const cv::Rect& where) {
  return cv::countNonZero(image(where)) / static_cast<double>(where.area());
}

FreeSpaceVotes Vote(const cv::Mat1f& now, const ReferenceView& reference) {
  const ReferenceView* references[] = {&reference};
  return VoteOnFreeSpace(kCamera, now, references, {});
}

/// At any distance, 5 m included.
class FreeSpaceAt : public testing::TestWithParam<float> {};

TEST_P(FreeSpaceAt, WhatHasComeIsSuspiciousAndWhatStaysIsStatic) {
  const float wall = GetParam();
  const FreeSpaceVotes votes = Vote(Depth(wall, 0.7f * wall, 1), Reference(Depth(wall, 0, 2)));
  const cv::Rect inside(kThing.x + 1, kThing.y + 1, kThing.width - 2, kThing.height - 2);
  EXPECT_GT(Share(votes.suspicious, inside), 0.99);
  EXPECT_GT(Share(votes.confirmed_static, cv::Rect(5, 5, 150, 30)), 0.99);
}

TEST_P(FreeSpaceAt, WhatAReferenceDoesNotSeeGetsNoVote) {
  const float wall = GetParam();
  ReferenceView reference = Reference(Depth(wall, 0, 2));
  constexpr int kShift = 70;  // cells
  reference.reference_from_current.translation.x() = kShift * wall / kCamera.fx;
  const FreeSpaceVotes votes = Vote(Depth(wall, 0, 1), reference);
  EXPECT_GT(Share(votes.num_static, cv::Rect(5, 5, kCamera.width - kShift - 10, 110)), 0.99);
  const cv::Rect unseen(kCamera.width - kShift + 1, 0, kShift - 1, kCamera.height);
  EXPECT_EQ(Share(votes.num_static, unseen), 0);
  EXPECT_EQ(Share(votes.num_free, unseen), 0);
}

TEST_P(FreeSpaceAt, NoiseAloneIsNotSuspicious) {
  const float wall = GetParam();
  const FreeSpaceVotes votes = Vote(Depth(wall, 0.7f * wall, 1), Reference(Depth(wall, 0.7f * wall, 2)));
  EXPECT_LT(Share(votes.suspicious, cv::Rect(0, 0, 160, 120)), 0.001);
}

TEST_P(FreeSpaceAt, WhatIsUncoveredIsNeither) {
  const float wall = GetParam();
  const FreeSpaceVotes votes = Vote(Depth(wall, 0, 1), Reference(Depth(wall, 0.7f * wall, 2)));
  const cv::Rect inside(kThing.x + 2, kThing.y + 2, kThing.width - 4, kThing.height - 4);
  EXPECT_EQ(Share(votes.suspicious, inside), 0);
  EXPECT_EQ(Share(votes.confirmed_static, inside), 0);
}

INSTANTIATE_TEST_SUITE_P(Distances, FreeSpaceAt, testing::Values(1.2f, 2.5f, 5.f));

TEST(FreeSpace, WhatWasMaskedThenConfirmsNothing) {
  ReferenceView reference = Reference(Depth(2, 1.5f, 1));
  reference.moving(kThing).setTo(255);
  EXPECT_EQ(Share(Vote(Depth(2, 1.5f, 2), reference).confirmed_static, kThing), 0);
}

TEST(FreeSpace, OneBentViewIsNotBelievedWhenItSeesThroughButTwoAre) {
  ReferenceView bent = Reference(Depth(3, 0, 1));
  bent.half_votes = 1;
  const cv::Mat1f now = Depth(3, 2, 2);
  const cv::Rect inside(kThing.x + 1, kThing.y + 1, kThing.width - 2, kThing.height - 2);
  EXPECT_EQ(Share(Vote(now, bent).suspicious, inside), 0);
  EXPECT_GT(Share(Vote(now, bent).confirmed_static, cv::Rect(5, 5, 150, 30)), 0.99);
  const ReferenceView* both[] = {&bent, &bent};
  EXPECT_GT(Share(VoteOnFreeSpace(kCamera, now, both, {}).suspicious, inside), 0.99);
}

TEST(FreeSpace, RulesCountedTogetherCountAsEachAlone) {
  ReferenceView with_it = Reference(Depth(2.5f, 1.5f, 1)), without = Reference(Depth(2.5f, 0, 2));
  with_it.age_frames = 5, without.age_frames = 20;
  with_it.reference_from_current.translation.x() = 0.02;
  const ReferenceView* references[] = {&with_it, &without};
  const cv::Mat1f now = Depth(2.5f, 1.5f, 3);
  const SightingRules rules[] = {{{}}, {{.gate_sigma = 1.f, .margin_m = 0}}, {{}, 10}, {{}, 30}};
  const std::vector<Sightings> together = CountSightings(kCamera, now, references, rules);
  ASSERT_EQ(together.size(), std::size(rules));
  for (size_t i = 0; i < together.size(); ++i) {
    const Sightings alone = CountSightings(kCamera, now, references, {&rules[i], 1}).front();
    EXPECT_EQ(cv::countNonZero(together[i].num_free != alone.num_free), 0) << i;
    EXPECT_EQ(cv::countNonZero(together[i].num_static != alone.num_static), 0) << i;
  }
  const cv::Point middle(kThing.x + kThing.width / 2, kThing.y + kThing.height / 2);
  EXPECT_EQ(together[0].num_static(middle), 1);  // who is five frames old saw it there, ...
  EXPECT_EQ(together[2].num_static(middle), 0);
  EXPECT_EQ(together[2].num_free(middle), 2);  // ... who is twenty saw through
  EXPECT_EQ(together[3].num_free(middle), 0);
}

TEST(FreeSpace, FollowsTheCamera) {
  ReferenceView reference = Reference(Depth(2, 0, 1));
  reference.reference_from_current.translation.z() = -0.5;  // the camera has come half a metre nearer ...
  EXPECT_GT(Share(Vote(Depth(2.5f, 0, 2), reference).confirmed_static, cv::Rect(40, 30, 80, 60)), 0.99);
  reference.reference_from_current.translation.z() = 0;
  EXPECT_EQ(Share(Vote(Depth(2.5f, 0, 2), reference).confirmed_static, cv::Rect(40, 30, 80, 60)), 0);
}

TEST(FreeSpace, WhatIsWithdrawnIsNeitherStaticNorJudgedSoButStaysSuspicious) {
  const FreeSpaceVotes before = Vote(Depth(3, 2, 1), Reference(Depth(3, 0, 2)));
  FreeSpaceVotes votes = Vote(Depth(3, 2, 1), Reference(Depth(3, 0, 2)));
  cv::Mat1b cells(votes.num_static.size(), uint8_t{0});
  const cv::Rect where(0, 0, 80, cells.rows);
  cells(where).setTo(255);
  WithdrawStatic(cells, &votes);
  ASSERT_GT(cv::countNonZero(before.num_static(where)), 0);
  EXPECT_EQ(cv::countNonZero(votes.num_static(where)), 0);
  EXPECT_EQ(cv::countNonZero(votes.confirmed_static(where)), 0);
  EXPECT_EQ(cv::countNonZero(votes.suspicious != before.suspicious), 0);
  const cv::Rect rest(80, 0, cells.cols - 80, cells.rows);
  EXPECT_EQ(cv::countNonZero(votes.num_static(rest) != before.num_static(rest)), 0);
}

TEST(Background, ABlackMonitorIsExpectedAlthoughNothingWasMeasuredThere) {
  const cv::Rect monitor(40, 40, 60, 40);
  auto frame = std::make_shared<WorkingFrame>();
  frame->depth_m = Depth(3, 0, 1);
  frame->depth_m(monitor).setTo(0);
  frame->pyramid.resize(3, cv::Mat1f(frame->depth_m.size(), 120.f));
  frame->pyramid[1] = cv::Mat1f(frame->depth_m.size(), 120.f);
  frame->pyramid[1](monitor).setTo(10);
  SceneHistory history(kCamera, {}, 0);
  history.Add(frame, cv::Mat1b(frame->depth_m.size(), uint8_t{0}), nullptr);
  const ReferenceView* references[] = {history.Back(1)};
  const BackgroundView view = RenderBackground(kCamera, *frame, references);
  const cv::Rect inside(monitor.x + 2, monitor.y + 2, monitor.width - 4, monitor.height - 4);
  EXPECT_EQ(Share(view.depth_m > 0, inside), 1);
  EXPECT_EQ(Share(view.brightest < 20, inside), 1);
}

TEST(Background, IsUnknownWhereNoReferenceLooked) {
  constexpr int kShift = 30;  // cells, to the left
  constexpr float kWallM = 2;
  ReferenceView reference = Reference(Depth(kWallM, 0, 1));
  auto frame = std::make_shared<WorkingFrame>(*reference.frame);
  frame->pyramid.resize(3, cv::Mat1f(frame->depth_m.size(), 120.f));
  reference.frame = frame, reference.filled_depth_m = frame->depth_m;
  reference.reference_from_current.translation.x() = -kShift * kWallM / kCamera.fx;
  WorkingFrame current = *frame;
  current.depth_m = cv::Mat1f(frame->depth_m.size(), 0.f);
  const ReferenceView* references[] = {&reference};
  const BackgroundView view = RenderBackground(kCamera, current, references);
  EXPECT_EQ(Share(view.depth_m, cv::Rect(0, 0, kShift - 3, kCamera.height)), 0);
  EXPECT_EQ(Share(view.depth_m, cv::Rect(kShift + 3, 5, kCamera.width - kShift - 3, 110)), 1);
}

/// Told from what both see, although the camera has gone on.
TEST(Background, IsAsBrightAsTheRoomIsNow) {
  constexpr float kWallM = 2;
  const cv::Rect hole(60, 50, 20, 20);
  ReferenceView reference = Reference(Depth(kWallM, 0, 1));
  auto frame = std::make_shared<WorkingFrame>(*reference.frame);
  frame->pyramid.resize(3, cv::Mat1f(frame->depth_m.size(), 120.f));
  reference.frame = frame, reference.filled_depth_m = frame->depth_m;
  reference.reference_from_current.translation.x() = -30 * kWallM / kCamera.fx;
  WorkingFrame current;
  current.depth_m = Depth(kWallM, 0, 2);
  current.depth_m(hole).setTo(0);
  current.pyramid.resize(3, cv::Mat1f(frame->depth_m.size(), 60.f));
  current.pyramid[1] = current.pyramid[1].clone();
  current.pyramid[1].colRange(0, 25).setTo(240);  // what the reference did not see
  const ReferenceView* references[] = {&reference};
  const BackgroundView view = RenderBackground(kCamera, current, references);
  EXPECT_EQ(Share(cv::abs(view.brightest - 60) < 1, hole), 1);
}

}  // namespace
}  // namespace orbslam
