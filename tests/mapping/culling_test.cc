// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/mapping/culling.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

class PointCullerTest : public SyntheticMap {
 protected:
  PointCullerTest() {
    for (int i = 0; i < 2; ++i) {
      Frame frame = SeeAndKnow(Rigid3d());
      AddKeyFrame(&frame);
    }
    points_ = PointsOf(KeyFrameId(0));
    std::erase_if(points_, [&](MapPointId id) { return map_.Read()->Find(id)->NumObservations() < 2; });
    for (const MapPointId id : points_) culler_.Watch(id, KeyFrameId(10));
  }
  int CullAt(uint32_t age) { return culler_.Cull(KeyFrameId(10 + age), &*map_.Write()); }
  bool IsAlive(MapPointId id) const { return map_.Read()->Find(id) != nullptr; }
  void SetFound(MapPointId id, int times_found) {
    const auto map = map_.Write();
    map->Find(id)->times_visible = 100;
    map->Find(id)->times_found = times_found;
  }

  const MappingOptions options_;
  PointCuller culler_{options_};
  std::vector<MapPointId> points_;
};

TEST_F(PointCullerTest, RarelyFoundPointsAreErasedAtOnce) {
  SetFound(points_[0], 24);
  SetFound(points_[1], 25);
  EXPECT_EQ(CullAt(0), 1);
  EXPECT_FALSE(IsAlive(points_[0]));
  EXPECT_TRUE(IsAlive(points_[1]));
  ExpectSound();
}

TEST_F(PointCullerTest, PointsThatNobodyElseComesToSeeAreErasedAfterAWhile) {
  map_.Write()->RemoveObservation(points_[0], KeyFrameId(1));
  EXPECT_EQ(CullAt(0) + CullAt(1), 0);
  EXPECT_EQ(CullAt(2), 1);
  EXPECT_FALSE(IsAlive(points_[0]));
  ExpectSound();
}

TEST_F(PointCullerTest, OldPointsAreTrustedForEver) {
  EXPECT_EQ(CullAt(3), 0);
  SetFound(points_[0], 0);
  EXPECT_EQ(CullAt(4), 0);
}

TEST_F(PointCullerTest, ForgottenAndErasedPointsAreNoHarm) {
  map_.Write()->EraseMapPoint(points_[0]);
  SetFound(points_[1], 0);
  EXPECT_EQ(CullAt(0), 1);
  SetFound(points_[2], 0);
  culler_.Clear();
  EXPECT_EQ(CullAt(0), 0);
}

class UnmeasuredPointTest : public PointCullerTest {
 protected:
  int CullUnconfirmed() { return culler_.CullUnconfirmed(&*map_.Write()); }
};

TEST_F(UnmeasuredPointTest, TwoKeyFramesAreNotBelieved) {
  ForgetDepths(KeyFrameId(0));
  ForgetDepths(KeyFrameId(1));
  EXPECT_EQ(CullUnconfirmed(), std::ssize(points_));
  for (const MapPointId id : points_) EXPECT_FALSE(IsAlive(id));
  ExpectSound();
}

TEST_F(UnmeasuredPointTest, OneMeasuredDepthIsEnough) {
  ForgetDepths(KeyFrameId(1));
  EXPECT_EQ(CullUnconfirmed(), 0);
}

TEST_F(UnmeasuredPointTest, AThirdKeyFrameConfirms) {
  Frame frame = SeeAndKnow(Rigid3d());
  AddKeyFrame(&frame);
  for (const uint32_t id : {0, 1, 2}) ForgetDepths(KeyFrameId(id));
  std::erase_if(points_, [&](MapPointId id) { return map_.Read()->Find(id)->NumObservations() < 3; });
  map_.Write()->RemoveObservation(points_[0], KeyFrameId(2));
  CullUnconfirmed();
  EXPECT_FALSE(IsAlive(points_[0]));
  EXPECT_GT(std::ssize(points_), 1);
  EXPECT_EQ(std::ranges::count_if(points_, [&](MapPointId id) { return IsAlive(id); }),
            std::ssize(points_) - 1);
}

class CullKeyFramesTest : public SyntheticMap {
 protected:
  KeyFrameId Add(const Rigid3d& camera_from_world) {
    Frame frame = SeeAndKnow(camera_from_world);
    return AddKeyFrame(&frame);
  }
  KeyFrameId AddNearby() { return Add(RandomMotion(&rng_, 0.01, 0.01)); }
  int CullAround(KeyFrameId id) { return CullKeyFrames(sensor_, options_, id, &*map_.Write()); }
  bool IsAlive(KeyFrameId id) const { return map_.Read()->Find(id) != nullptr; }

  const MappingOptions options_;
};

TEST_F(CullKeyFramesTest, OneOfManyThatSeeTheSameIsErased) {
  const KeyFrameId root = AddNearby();
  for (int i = 0; i < 2; ++i) AddNearby();
  const KeyFrameId last = AddNearby();
  EXPECT_EQ(CullAround(last), 1) << "three must be left";
  EXPECT_TRUE(IsAlive(root));
  EXPECT_TRUE(IsAlive(last));
  ExpectSound();
  EXPECT_EQ(CullAround(last), 0);
}

TEST_F(CullKeyFramesTest, TheOnlyOnesThatSeeSomethingStay) {
  std::vector<KeyFrameId> needed;
  for (int i = 0; i < 4; ++i) needed.push_back(Add({So3Exp({0, 0.35 * (i - 2), 0}), {0, 0, 0}}));
  for (const KeyFrameId id : needed) EXPECT_EQ(CullAround(id), 0);
}

TEST_F(CullKeyFramesTest, FourthObserverAtACoarserScaleIsNotEnough) {
  std::vector<KeyFrameId> all;
  for (int i = 0; i < 4; ++i) all.push_back(AddNearby());
  for (const KeyFrameId id : {all[0], all[2], all[3]}) {  // all but all[1] see two levels coarser
    const auto map = map_.Write();
    auto features = std::make_shared<FrameFeatures>(*map->Find(id)->features);
    for (int& level : features->levels) level += 2;
    map->Find(id)->features = features;
  }
  CullAround(all[3]);
  EXPECT_TRUE(IsAlive(all[1]));
  EXPECT_FALSE(IsAlive(all[2])) << "sees no finer than the others";
}

TEST_F(CullKeyFramesTest, EndsOfLoopsStay) {
  std::vector<KeyFrameId> all;
  for (int i = 0; i < 6; ++i) all.push_back(AddNearby());
  map_.Write()->AddLoopEdge(all[1], all[4]);
  CullAround(all[5]);
  for (const KeyFrameId kept : {all[0], all[1], all[4], all[5]}) EXPECT_TRUE(IsAlive(kept));
  ExpectSound();
}

TEST_F(CullKeyFramesTest, AnUnknownKeyFrameIsNoHarm) { EXPECT_EQ(CullAround(KeyFrameId(5)), 0); }

}  // namespace
}  // namespace orbslam::test
