// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/frame_tracker.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

class FrameTrackerTest : public SyntheticMap {
 protected:
  FrameTrackerTest() { keyframe_ = AddKeyFrame(&last_); }

  /// The next frame with a prediction that is off by so much.
  Frame NextFrame(double error_rad, double error_m) {
    Frame frame = See(truth_);
    frame.camera_from_world =
        Rigid3d{So3Exp(error_rad * RandomDirection(&rng_)), error_m * RandomDirection(&rng_)} * truth_;
    return frame;
  }
  void ExpectTracked(int num_inliers, const Frame& frame, int at_least = 300) {
    EXPECT_GT(num_inliers, at_least);
    EXPECT_EQ(num_inliers, frame.NumPoints());
    EXPECT_THAT(frame.camera_from_world, Rigid3dNear(truth_, kMaxErrorM, kMaxErrorRad));
    EXPECT_GT(ShareOfRightPoints(frame), 0.99);
  }

  const TrackingOptions options_;
  const FrameTracker tracker_{map_, sensor_, options_};
  Frame last_ = SeeAndKnow(Rigid3d());
  KeyFrameId keyframe_;
  const Rigid3d truth_ = RandomMotion(&rng_, 0.05, 0.05);
};

TEST_F(FrameTrackerTest, PredictionIsCorrected) {
  for (int i = 0; i < 10; ++i) {
    Frame frame = NextFrame(0.005, 0.005);
    ExpectTracked(tracker_.TrackLastFrame(last_, &frame), frame);
  }
}

TEST_F(FrameTrackerTest, PoorPredictionIsCorrectedWithAWiderWindow) {
  Frame frame = NextFrame(0, 0);
  frame.camera_from_world = Rigid3d{So3Exp({0, 0.033, 0}), {0, 0, 0}} * truth_;  // 17 px
  ExpectTracked(tracker_.TrackLastFrame(last_, &frame), frame, 200);
}

TEST_F(FrameTrackerTest, WrongPredictionFailsAndIsSavedByTheKeyFrame) {
  for (int i = 0; i < 5; ++i) {
    Frame frame = NextFrame(0, 0);
    frame.camera_from_world = Rigid3d{So3Exp({0, 0.4, 0}), RandomVector(&rng_, 0.1)} * truth_;  // 200 px
    EXPECT_LT(tracker_.TrackLastFrame(last_, &frame), options_.min_inliers);
    frame.camera_from_world = last_.camera_from_world;
    ExpectTracked(tracker_.TrackKeyFrame(keyframe_, &frame), frame);
  }
}

TEST_F(FrameTrackerTest, KeyFrameIsFoundFromAnyPriorNearby) {
  for (int i = 0; i < 10; ++i) {
    Frame frame = NextFrame(0.15, 0.2);
    ExpectTracked(tracker_.TrackKeyFrame(keyframe_, &frame), frame);
  }
}

TEST_F(FrameTrackerTest, WhatAPoseSaidOfNearPointsGoesWithIt) {
  Frame frame = NextFrame(0.002, 0.002);
  frame.moving_below_m = 2;
  Frame again = frame;
  ExpectTracked(tracker_.TrackLastFrame(last_, &frame), frame);
  EXPECT_EQ(frame.moving_below_m, 0);
  ExpectTracked(tracker_.TrackKeyFrame(keyframe_, &again), again);
  EXPECT_EQ(again.moving_below_m, 0);
}

TEST_F(FrameTrackerTest, FollowsPointsThatWereFusedMeanwhile) {
  std::vector<MapPointId> fused(last_.points.begin(), last_.points.begin() + 100);
  {
    const auto map = map_.Write();
    const KeyFrameId other = map->AddKeyFrame(FrameId(7), 7, last_.camera_from_world, last_.features);
    for (int i = 0; i < 100; ++i) {
      const MapPointId target = map->AddMapPoint(map->Find(fused[i])->position_world, other);
      map->AddObservation(target, other, i);
      map->FuseMapPoint(fused[i], target);
    }
  }
  Frame frame = NextFrame(0.002, 0.002);
  ExpectTracked(tracker_.TrackLastFrame(last_, &frame), frame);
  for (const MapPointId id : fused) {
    EXPECT_EQ(std::ranges::count(frame.points, id), 0);
    EXPECT_TRUE(map_.Read()->Resolve(id).IsValid());
  }
}

TEST_F(FrameTrackerTest, UnknownKeyFrameAndFeaturelessFrameFail) {
  Frame frame = NextFrame(0, 0);
  EXPECT_EQ(tracker_.TrackKeyFrame(KeyFrameId(99), &frame), 0);
  frame.features = std::make_shared<const FrameFeatures>();
  frame.points.clear();
  EXPECT_EQ(tracker_.TrackLastFrame(last_, &frame), 0);
  EXPECT_EQ(tracker_.TrackKeyFrame(keyframe_, &frame), 0);
}

}  // namespace
}  // namespace orbslam::test
