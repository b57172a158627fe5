// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/keyframe_creator.h"

#include <algorithm>

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

using testing::IsEmpty;

class KeyFrameCreator : public SyntheticMap {
 protected:
  KeyFrameCreator() { noise_ = {}; }

  /// Depth of the farthest keypoint with a point, and of the nearest with depth but without.
  static std::pair<float, float> FarthestMadeAndNearestLeft(const Frame& frame) {
    float farthest_made = 0, nearest_left = 1000;
    for (int i = 0; i < frame.features->size(); ++i) {
      const float depth_m = frame.features->depths_m[i];
      if (frame.points[i].IsValid())
        farthest_made = std::max(farthest_made, depth_m);
      else if (depth_m > 0)
        nearest_left = std::min(nearest_left, depth_m);
    }
    return {farthest_made, nearest_left};
  }

  const double close_limit_m_ = sensor_.depth.CloseLimitM(sensor_.camera.fx);
};

TEST_F(KeyFrameCreator, MakesAllClosePointsAndNoneBeyondWhenThatIsEnough) {
  Frame frame = SeeAndKnow(Rigid3d());
  AddKeyFrame(&frame, 100);
  const auto [farthest_made, nearest_left] = FarthestMadeAndNearestLeft(frame);
  EXPECT_GT(frame.NumPoints(), 100);
  EXPECT_LE(farthest_made, close_limit_m_);
  EXPECT_GT(nearest_left, close_limit_m_);
}

TEST_F(KeyFrameCreator, GoesOnWithTheClosestUntilThereAreEnough) {
  Frame frame = SeeAndKnow(Rigid3d());
  const int wanted = frame.features->size() - 50;
  AddKeyFrame(&frame, wanted);
  const auto [farthest_made, nearest_left] = FarthestMadeAndNearestLeft(frame);
  EXPECT_EQ(frame.NumPoints(), wanted);
  EXPECT_GT(farthest_made, close_limit_m_);
  EXPECT_LE(farthest_made, nearest_left);
}

TEST_F(KeyFrameCreator, PutsPointsWhereTheLandmarksAre) {
  Frame frame = SeeAndKnow(RandomMotion(&rng_, 0.3, 0.3));
  AddKeyFrame(&frame);
  const auto map = map_.Read();
  for (int i = 0; i < frame.features->size(); ++i) {
    const MapPoint* point = map->Find(frame.points[i]);
    ASSERT_NE(point, nullptr);
    EXPECT_THAT(point->position_world, MatrixNear(landmarks_[LandmarkAt(frame, i)].position_world, 1e-5));
    EXPECT_EQ(point->descriptor, frame.features->descriptors[i]);
    EXPECT_GT(point->max_distance_m, 0) << "refreshed";
  }
}

TEST_F(KeyFrameCreator, KeypointsWithoutDepthGetNoPoint) {
  Frame frame = SeeAndKnow(Rigid3d());
  FrameFeatures features = *frame.features;
  for (int i = 0; i < features.size(); i += 3) features.depths_m[i] = features.right_u[i] = -1;
  frame.features = std::make_shared<const FrameFeatures>(features);
  AddKeyFrame(&frame);
  for (int i = 0; i < features.size(); ++i) EXPECT_EQ(frame.points[i].IsValid(), features.HasDepth(i));
}

TEST_F(KeyFrameCreator, MakesNoPointOfWhatMoves) {
  Frame frame = SeeAndKnow(Rigid3d());
  frame.moving_below_m = 2;
  AddKeyFrame(&frame);
  const FrameFeatures& features = *frame.features;
  for (int i = 0; i < features.size(); ++i) EXPECT_EQ(frame.points[i].IsValid(), features.depths_m[i] >= 2);
}

TEST_F(KeyFrameCreator, SecondKeyFrameObservesKnownPointsAndMakesOnlyTheMissing) {
  Frame first = SeeAndKnow(Rigid3d());
  const KeyFrameId root = AddKeyFrame(&first);
  Frame second = SeeAndKnow(RandomMotion(&rng_, 0.1, 0.1));
  const int num_known = second.NumPoints(), num_before = map_.Read()->num_points();
  ASSERT_GT(num_known, 300);
  const KeyFrameId id = AddKeyFrame(&second);
  const auto map = map_.Read();
  EXPECT_THAT(FindBrokenInvariants(*map), IsEmpty());
  EXPECT_EQ(map->num_points() - num_before, second.features->size() - num_known);
  EXPECT_EQ(map->Find(id)->points, second.points) << "the frame is up to date";
  EXPECT_EQ(map->Find(id)->parent, root);
  EXPECT_EQ(map->Find(id)->covisibles.front().num_shared_points, num_known);
}

TEST_F(KeyFrameCreator, PoseOfAnOlderEpochMakesNoKeyFrame) {
  Frame first = SeeAndKnow(Rigid3d());
  AddKeyFrame(&first);
  Frame second = SeeAndKnow(Rigid3d());
  const std::vector<MapPointId> points = second.points;
  const uint64_t epoch = Epoch();
  map_.Write()->BumpEpoch();
  EXPECT_FALSE(CreateKeyFrame(sensor_, 100, KeyFrameId(0), epoch, &second, &map_));
  EXPECT_EQ(second.points, points);
  EXPECT_EQ(map_.Read()->num_keyframes(), 1);
}

TEST_F(KeyFrameCreator, HangsBelowTheHeirOfACulledFallbackIfItSharesNothing) {
  Frame first = SeeAndKnow(Rigid3d()), second = SeeAndKnow(Rigid3d()), stranger = See(Rigid3d());
  const KeyFrameId root = AddKeyFrame(&first), culled = AddKeyFrame(&second);
  ASSERT_TRUE(map_.Write()->EraseKeyFrame(culled));
  const auto id = CreateKeyFrame(sensor_, 100, culled, Epoch(), &stranger, &map_);
  ASSERT_TRUE(id);
  EXPECT_EQ(map_.Read()->Find(*id)->parent, root);
}

TEST_F(KeyFrameCreator, FollowsFusedPointsAndForgetsErasedAndDoubledOnes) {
  Frame first = SeeAndKnow(Rigid3d());
  AddKeyFrame(&first);
  Frame second = SeeAndKnow(Rigid3d());
  const MapPointId erased = second.points[0], fused = second.points[1], target = second.points[2];
  {
    const auto map = map_.Write();
    map->EraseMapPoint(erased);
    map->FuseMapPoint(fused, target);
  }
  const KeyFrameId id = AddKeyFrame(&second);
  const auto map = map_.Read();
  EXPECT_THAT(FindBrokenInvariants(*map), IsEmpty());
  EXPECT_NE(second.points[0], erased);
  EXPECT_EQ(second.points[1], target);
  EXPECT_NE(second.points[2], target) << "a keyframe sees a point once";
  EXPECT_EQ(map->Find(id)->points, second.points);
}

}  // namespace
}  // namespace orbslam::test
