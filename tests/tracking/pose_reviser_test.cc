// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_reviser.h"

#include <limits>

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

/// One keyframe, and frames from elsewhere whose first poses are wrong by centimetres.
class PoseReviserTest : public SyntheticMap {
 protected:
  PoseReviserTest() {
    Frame frame = SeeAndKnow(keyframe_from_world_);
    keyframe_ = AddKeyFrame(&frame);
  }

  Frame FrameWithWrongPose() {
    Frame frame = SeeAndKnow(truth_);
    frame.camera_from_world = wrong_;
    return frame;
  }
  void Keep(const Frame& frame) {
    reviser_.Keep(frame, keyframe_, frame.camera_from_world * Inverse(keyframe_from_world_));
  }
  /// All that is revised is this frame, and its pose is the true one.
  void ExpectTruthOf(FrameId frame) {
    const std::vector<RevisedPose> revised = reviser_.ReviseUntil(kForever);
    ASSERT_EQ(revised.size(), 1u);
    EXPECT_EQ(revised[0].frame, frame);
    EXPECT_THAT(revised[0].camera_from_reference,
                Rigid3dNear(truth_ * Inverse(keyframe_from_world_), kMaxErrorM, kMaxErrorRad));
  }

  const Rigid3d keyframe_from_world_{So3Exp({0.02, 0.1, 0}), {0.05, 0, 0.02}};
  const Rigid3d truth_{So3Exp({0, -0.05, 0.03}), {-0.1, 0.05, 0}};
  const Rigid3d wrong_ = Rigid3d{So3Exp({0.01, 0, 0.01}), {0.03, 0.02, 0}} * truth_;
  PoseReviser reviser_{map_, sensor_};
  KeyFrameId keyframe_;
};

TEST_F(PoseReviserTest, FindsThePoseThatThePointsTell) {
  const Frame frame = FrameWithWrongPose();
  Keep(frame);
  ExpectTruthOf(frame.id);
}

TEST_F(PoseReviserTest, FollowsWhatTheMapHasLearnedSince) {
  const Frame frame = FrameWithWrongPose();
  Keep(frame);
  const Rigid3d moved_from_world{So3Exp({0, 0, 0.02}), {0.03, 0, 0}};  // by an adjustment of everything
  {
    const auto map = map_.Write();
    map->Find(keyframe_)->camera_from_world = keyframe_from_world_ * Inverse(moved_from_world);
    for (const auto& [landmark, point] : point_of_)
      map->Find(point)->position_world = moved_from_world * map->Find(point)->position_world;
  }
  ExpectTruthOf(frame.id);
}

TEST_F(PoseReviserTest, WhatIsLeftOfThePointsTellsThePose) {
  const Frame frame = FrameWithWrongPose();
  Keep(frame);
  {
    const auto map = map_.Write();
    for (int i = 0; i < frame.features->size(); i += 3)
      if (frame.points[i].IsValid()) map->EraseMapPoint(frame.points[i]);
  }
  ExpectTruthOf(frame.id);
}

TEST_F(PoseReviserTest, WhereMostPointsAreGoneTheFirstPoseStands) {
  const Frame frame = FrameWithWrongPose();
  Keep(frame);
  {
    const auto map = map_.Write();
    int num_left = 0;
    for (const MapPointId id : frame.points)
      if (id.IsValid() && ++num_left > frame.NumPoints() / 3) map->EraseMapPoint(id);
  }
  EXPECT_TRUE(reviser_.ReviseUntil(kForever).empty());
}

TEST_F(PoseReviserTest, AKeyFramesOwnPoseIsTheMaps) {
  Frame frame = SeeAndKnow(truth_);
  const KeyFrameId id = AddKeyFrame(&frame);
  reviser_.Keep(frame, id, Rigid3d());
  EXPECT_TRUE(reviser_.ReviseUntil(kForever).empty());
}

TEST_F(PoseReviserTest, EachFrameHasItsTurnOnceWhenItIsOldEnough) {
  std::vector<Frame> frames;
  for (int i = 0; i < 5; ++i) {
    frames.push_back(FrameWithWrongPose());
    Keep(frames.back());
  }
  EXPECT_TRUE(reviser_.ReviseUntil(frames[0].timestamp_s - 0.001).empty());
  const std::vector<RevisedPose> first = reviser_.ReviseUntil(frames[1].timestamp_s);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].frame, frames[0].id);
  EXPECT_EQ(first[1].frame, frames[1].id);
  EXPECT_TRUE(reviser_.ReviseUntil(frames[1].timestamp_s).empty());
  EXPECT_EQ(reviser_.ReviseUntil(kForever).size(), 3u);
}

}  // namespace
}  // namespace orbslam::test
