// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_reviser.h"

#include <limits>

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

class PoseReviserTest : public SyntheticMap {
 protected:
  PoseReviserTest() {
    Frame frame = SeeAndKnow(Rigid3d());
    keyframe_ = AddKeyFrame(&frame);
  }
  /// A frame beside the keyframe that was thought to be where that is.
  PastFrame FrameWithWrongPose() {
    const Frame frame = SeeAndKnow(truth_);
    return {frame.id, frame.timestamp_s, keyframe_, Rigid3d(), {}, SightingsOf(frame)};
  }

  const Rigid3d truth_{So3Exp({0, -0.01, 0.01}), {-0.02, 0.01, 0}};
  PoseReviser reviser_{map_, sensor_};
  KeyFrameId keyframe_;
};

TEST_F(PoseReviserTest, EachFrameHasItsTurnOnceWhenItIsOldEnough) {
  std::vector<PastFrame> frames;
  for (int i = 0; i < 5; ++i) {
    frames.push_back(FrameWithWrongPose());
    reviser_.Keep(frames.back());
  }
  EXPECT_TRUE(reviser_.ReviseUntil(frames[0].timestamp_s - 0.001).empty());
  const std::vector<PastFrame> first = reviser_.ReviseUntil(frames[1].timestamp_s);
  ASSERT_EQ(first.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(first[i].id, frames[i].id);
    EXPECT_THAT(first[i].camera_from_reference, Rigid3dNear(truth_, kMaxErrorM, kMaxErrorRad));
  }
  EXPECT_TRUE(reviser_.ReviseUntil(frames[1].timestamp_s).empty());
  EXPECT_EQ(reviser_.ReviseUntil(kForever).size(), 3u);
}

TEST_F(PoseReviserTest, WhatIsRetractedCountsInOlderFramesAlone) {
  std::vector<PastFrame> frames;
  for (int i = 0; i < 4; ++i) {
    frames.push_back(FrameWithWrongPose());
    reviser_.Keep(frames.back());
  }
  std::vector<MapPointId> set_off;
  for (size_t i = 0; i < frames[0].sightings.size(); i += 4) set_off.push_back(frames[0].sightings[i].point);
  std::ranges::reverse(set_off);  // any order
  reviser_.Retract(set_off, frames[1].timestamp_s);
  const std::vector<PastFrame> revised = reviser_.ReviseUntil(kForever);
  ASSERT_EQ(revised.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const auto num_set_off = std::ranges::count_if(revised[i].sightings, [&](const Sighting& sighting) {
      return std::ranges::count(set_off, sighting.point) > 0;
    });
    EXPECT_EQ(num_set_off, i < 2 ? std::ssize(set_off) : 0) << i;
    EXPECT_EQ(std::ssize(revised[i].sightings) - num_set_off,
              std::ssize(frames[i].sightings) - std::ssize(set_off));
    EXPECT_THAT(revised[i].camera_from_reference, Rigid3dNear(truth_, kMaxErrorM, kMaxErrorRad));
  }
}

TEST_F(PoseReviserTest, WhatIsNotFoundAgainIsForgotten) {
  PastFrame blind = FrameWithWrongPose();
  blind.sightings.clear();
  reviser_.Keep(blind);
  reviser_.Keep(FrameWithWrongPose());
  EXPECT_EQ(reviser_.ReviseUntil(kForever).size(), 1u);
}

}  // namespace
}  // namespace orbslam::test
