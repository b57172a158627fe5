// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/past_frame.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

/// One keyframe, and frames from elsewhere whose first poses are wrong by centimetres.
class PastFrameTest : public SyntheticMap {
 protected:
  PastFrameTest() {
    Frame frame = SeeAndKnow(keyframe_from_world_);
    keyframe_ = AddKeyFrame(&frame);
  }

  PastFrame FrameWithWrongPose() {
    const Frame frame = SeeAndKnow(truth_);
    return {frame.id, frame.timestamp_s, keyframe_, wrong_ * Inverse(keyframe_from_world_),
            {},       SightingsOf(frame)};
  }
  void ExpectTruth(const PastFrame& frame) const {
    EXPECT_THAT(frame.camera_from_reference,
                Rigid3dNear(truth_ * Inverse(keyframe_from_world_), kMaxErrorM, kMaxErrorRad));
    EXPECT_GT(frame.pose_information(0, 0), 0);
  }

  const Rigid3d keyframe_from_world_{So3Exp({0.02, 0.1, 0}), {0.05, 0, 0.02}};
  const Rigid3d truth_{So3Exp({0, -0.05, 0.03}), {-0.1, 0.05, 0}};
  const Rigid3d wrong_ = Rigid3d{So3Exp({0.01, 0, 0.01}), {0.03, 0.02, 0}} * truth_;
  KeyFrameId keyframe_;
};

TEST_F(PastFrameTest, SightingsAreTheKeypointsThatShowPoints) {
  const Frame frame = SeeAndKnow(truth_);
  const std::vector<Sighting> sightings = SightingsOf(frame);
  ASSERT_EQ(std::ssize(sightings), frame.NumPoints());
  auto sighting = sightings.begin();
  for (int i = 0; i < frame.features->size(); ++i) {
    if (!frame.points[i].IsValid()) continue;
    EXPECT_EQ(sighting->point, frame.points[i]);
    EXPECT_EQ(sighting->pixel.x(), frame.features->pixels[i].x);
    EXPECT_EQ(sighting->pixel.y(), frame.features->pixels[i].y);
    EXPECT_EQ(sighting->pixel.z(), frame.features->right_u[i]);
    EXPECT_EQ(sighting->level, frame.features->levels[i]);
    ++sighting;
  }
}

TEST_F(PastFrameTest, ThePointsTellThePose) {
  PastFrame frame = FrameWithWrongPose();
  const size_t num_sightings = frame.sightings.size();
  EXPECT_TRUE(FindPoseAgain(map_, sensor_, &frame));
  ExpectTruth(frame);
  EXPECT_EQ(frame.sightings.size(), num_sightings);
}

TEST_F(PastFrameTest, FollowsWhatTheMapHasLearnedSince) {
  PastFrame frame = FrameWithWrongPose();
  const Rigid3d moved_from_world{So3Exp({0, 0, 0.02}), {0.03, 0, 0}};  // by an adjustment of everything
  {
    const auto map = map_.Write();
    map->Find(keyframe_)->camera_from_world = keyframe_from_world_ * Inverse(moved_from_world);
    for (const auto& [landmark, point] : point_of_)
      map->Find(point)->position_world = moved_from_world * map->Find(point)->position_world;
  }
  EXPECT_TRUE(FindPoseAgain(map_, sensor_, &frame));
  ExpectTruth(frame);
}

TEST_F(PastFrameTest, WhatIsLeftOfThePointsTellsThePose) {
  PastFrame frame = FrameWithWrongPose();
  const size_t num_sightings = frame.sightings.size();
  {
    const auto map = map_.Write();
    for (size_t i = 0; i < num_sightings; i += 3) map->EraseMapPoint(frame.sightings[i].point);
  }
  EXPECT_TRUE(FindPoseAgain(map_, sensor_, &frame));
  ExpectTruth(frame);
  EXPECT_EQ(frame.sightings.size(), num_sightings - (num_sightings + 2) / 3) << "the erased are forgotten";
}

TEST_F(PastFrameTest, WhereMostPointsAreGoneTheFirstPoseStands) {
  PastFrame frame = FrameWithWrongPose();
  {
    const auto map = map_.Write();
    for (size_t i = frame.sightings.size() / 3; i < frame.sightings.size(); ++i)
      map->EraseMapPoint(frame.sightings[i].point);
  }
  EXPECT_FALSE(FindPoseAgain(map_, sensor_, &frame));
  EXPECT_EQ(frame.camera_from_reference.translation, (wrong_ * Inverse(keyframe_from_world_)).translation);
}

TEST_F(PastFrameTest, WithoutSightingsNothingIsFound) {
  PastFrame frame = FrameWithWrongPose();
  frame.sightings.clear();
  EXPECT_FALSE(FindPoseAgain(map_, sensor_, &frame));
}

TEST_F(PastFrameTest, AKeyFramesOwnPoseIsTheMaps) {
  Frame frame = SeeAndKnow(truth_);
  const KeyFrameId id = AddKeyFrame(&frame);
  PastFrame past{frame.id, frame.timestamp_s, id, Rigid3d(), {}, SightingsOf(frame)};
  EXPECT_FALSE(FindPoseAgain(map_, sensor_, &past));
}

}  // namespace
}  // namespace orbslam::test
