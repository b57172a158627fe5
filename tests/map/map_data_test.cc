// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/map/map_data.h"

#include "map/random_map.h"

namespace orbslam::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class MapDataTest : public testing::Test {
 protected:
  KeyFrameId AddKeyFrame(KeyFrameId parent) {
    const KeyFrameId id = map_.AddKeyFrame(FrameId(0), 0, RandomMotion(&rng_), RandomFeatures(20, &rng_));
    map_.ConnectToSpanningTree(id, parent);
    return id;
  }
  MapPointId AddPoint(const std::vector<KeyFrameId>& seen_by) {
    const MapPointId id = map_.AddMapPoint(RandomVector(&rng_, 1), seen_by.front());
    for (const KeyFrameId keyframe : seen_by) {
      const auto& points = map_.Find(keyframe)->points;
      const auto free = std::ranges::find(points, MapPointId()) - points.begin();
      EXPECT_TRUE(map_.AddObservation(id, keyframe, static_cast<int>(free)));
    }
    return id;
  }
  void Move(KeyFrameId id) { map_.Find(id)->camera_from_world = RandomMotion(&rng_); }

  Rng rng_{11};
  MapData map_{ScalePyramid(8, 1.2)};
  KeyFrameId root_ = AddKeyFrame({}), a_ = AddKeyFrame(root_), b_ = AddKeyFrame(a_), c_ = AddKeyFrame(b_);
};

TEST_F(MapDataTest, CulledKeyFrameFollowsItsParent) {
  const Rigid3d b_from_a = map_.Find(b_)->camera_from_world * Inverse(map_.Find(a_)->camera_from_world);
  ASSERT_TRUE(map_.EraseKeyFrame(b_));
  Move(a_);
  EXPECT_THAT(*map_.CameraFromWorld(b_), Rigid3dNear(b_from_a * map_.Find(a_)->camera_from_world, 1e-13));
}

TEST_F(MapDataTest, ChainsOfCulledKeyFramesFollowTheFirstThatLives) {
  const Rigid3d c_from_root = map_.Find(c_)->camera_from_world * Inverse(map_.Find(root_)->camera_from_world);
  for (const KeyFrameId id : {c_, b_, a_}) ASSERT_TRUE(map_.EraseKeyFrame(id));
  Move(root_);
  EXPECT_THAT(*map_.CameraFromWorld(c_),
              Rigid3dNear(c_from_root * map_.Find(root_)->camera_from_world, 1e-13));
}

TEST_F(MapDataTest, PoseOfAKeyFrameThatNeverWasIsNothing) {
  EXPECT_FALSE(map_.CameraFromWorld(KeyFrameId(99)));
  EXPECT_FALSE(map_.CameraFromWorld(KeyFrameId()));
}

TEST_F(MapDataTest, CulledKeyFrameResolvesToItsNearestLivingAncestor) {
  EXPECT_EQ(map_.Resolve(c_), c_);
  for (const KeyFrameId id : {c_, b_}) ASSERT_TRUE(map_.EraseKeyFrame(id));
  EXPECT_EQ(map_.Resolve(c_), a_);
  EXPECT_FALSE(map_.Resolve(KeyFrameId(99)).IsValid());
}

TEST_F(MapDataTest, RootAndKeyFramesWithLoopEdgesStay) {
  map_.AddLoopEdge(a_, c_);
  for (const KeyFrameId id : {root_, a_, c_}) {
    EXPECT_FALSE(map_.EraseKeyFrame(id));
    EXPECT_NE(map_.Find(id), nullptr);
  }
  EXPECT_FALSE(map_.EraseKeyFrame(KeyFrameId(99)));
  EXPECT_THAT(FindBrokenInvariants(map_), IsEmpty());
}

TEST_F(MapDataTest, NewKeyFrameHangsBelowTheBestCovisible) {
  for (int i = 0; i < 3; ++i) AddPoint({a_});
  AddPoint({c_});
  const KeyFrameId id = map_.AddKeyFrame(FrameId(9), 1, Rigid3d(), RandomFeatures(20, &rng_));
  int keypoint = 0;
  for (const MapPoint& point : map_.MapPoints()) map_.AddObservation(point.id, id, keypoint++);
  map_.ConnectToSpanningTree(id, root_);
  EXPECT_EQ(map_.Find(id)->parent, a_);
}

TEST_F(MapDataTest, OrphansMoveToTheirBestCovisibleOrElseToTheGrandparent) {
  const KeyFrameId uncle = AddKeyFrame(root_), sibling = AddKeyFrame(b_);
  AddPoint({c_, uncle});
  ASSERT_TRUE(map_.EraseKeyFrame(b_));
  EXPECT_EQ(map_.Find(c_)->parent, uncle);
  EXPECT_EQ(map_.Find(sibling)->parent, a_);
  EXPECT_THAT(FindBrokenInvariants(map_), IsEmpty());
}

TEST_F(MapDataTest, OrphansNeverMoveBelowThemselves) {
  const KeyFrameId grandchild = AddKeyFrame(c_);
  AddPoint({c_, grandchild});
  ASSERT_TRUE(map_.EraseKeyFrame(b_));
  EXPECT_EQ(map_.Find(c_)->parent, a_);
  EXPECT_THAT(FindBrokenInvariants(map_), IsEmpty());
}

TEST_F(MapDataTest, PointsDieWithTheirLastObserver) {
  const MapPointId only_b = AddPoint({b_}), both = AddPoint({a_, b_});
  ASSERT_TRUE(map_.EraseKeyFrame(b_));
  EXPECT_EQ(map_.Find(only_b), nullptr);
  EXPECT_THAT(map_.Find(both)->observations, ElementsAre(testing::Field(&Observation::keyframe, a_)));
}

TEST_F(MapDataTest, CovisibilityCountsSharedPoints) {
  AddPoint({a_, b_});
  AddPoint({a_, b_, c_});
  EXPECT_THAT(map_.Find(a_)->covisibles, ElementsAre(Covisible{b_, 2}, Covisible{c_, 1}));
}

TEST_F(MapDataTest, EpochCountsUp) {
  const uint64_t before = map_.epoch();
  map_.BumpEpoch();
  EXPECT_EQ(map_.epoch(), before + 1);
}

}  // namespace
}  // namespace orbslam::test
