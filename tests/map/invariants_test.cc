// SPDX-License-Identifier: GPL-3.0-or-later
// The inspector must see every kind of damage, or the other tests of the map prove nothing.
#include "orbslam/map/invariants.h"

#include "map/random_map.h"

namespace orbslam::test {
namespace {

using testing::IsEmpty;
using testing::Not;

class Invariants : public testing::Test {
 protected:
  Invariants() {
    RandomMap edits(&map_, &rng_);
    for (int i = 0; i < 6; ++i) edits.AddKeyFrame();
    for (int i = 0; i < 40; ++i) edits.AddMapPoint();
  }
  MapPoint& PointSeenTwice() {
    for (MapPoint& point : map_.MutableMapPoints()) {
      if (point.NumObservations() >= 2) return point;
    }
    ADD_FAILURE() << "no point is seen twice";
    return *map_.Find(MapPointId(0));
  }
  KeyFrame& Youngest() { return *map_.Find(map_.last_keyframe_id()); }
  void ExpectBroken() { EXPECT_THAT(FindBrokenInvariants(map_), Not(IsEmpty())); }

  Rng rng_{15};
  MapData map_{ScalePyramid(8, 1.2)};
};

TEST_F(Invariants, HoldInASoundMap) {
  EXPECT_THAT(FindBrokenInvariants(map_), IsEmpty());
  EXPECT_THAT(FindBrokenInvariants(MapData(ScalePyramid(8, 1.2))), IsEmpty());
}

TEST_F(Invariants, KeyFrameForgetsAPoint) {
  const auto [keyframe, keypoint] = PointSeenTwice().observations.front();
  map_.Find(keyframe)->points[keypoint] = MapPointId();
  ExpectBroken();
}

TEST_F(Invariants, PointForgetsAKeyFrame) {
  PointSeenTwice().observations.pop_back();
  ExpectBroken();
}

TEST_F(Invariants, PointThatNobodySees) {
  map_.AddMapPoint(Eigen::Vector3d::Zero(), KeyFrameId(0));
  ExpectBroken();
}

TEST_F(Invariants, UnsortedObservations) {
  std::ranges::reverse(PointSeenTwice().observations);
  ExpectBroken();
}

TEST_F(Invariants, DoubledObservation) {
  auto& observations = PointSeenTwice().observations;
  observations.insert(observations.begin(), observations.front());
  ExpectBroken();
}

TEST_F(Invariants, KeyFrameSeesAPointTwice) {
  const MapPoint& point = PointSeenTwice();
  auto& points = map_.Find(point.observations.front().keyframe)->points;
  *std::ranges::find(points, MapPointId()) = point.id;
  ExpectBroken();
}

TEST_F(Invariants, KeyFrameSeesAPointThatIsGone) {
  *std::ranges::find(Youngest().points, MapPointId()) = MapPointId(99999);
  ExpectBroken();
}

TEST_F(Invariants, WrongCovisibilityWeight) {
  ++map_.Find(PointSeenTwice().observations.front().keyframe)->covisibles.front().num_shared_points;
  ExpectBroken();
}

TEST_F(Invariants, MissingCovisible) {
  map_.Find(PointSeenTwice().observations.front().keyframe)->covisibles.pop_back();
  ExpectBroken();
}

TEST_F(Invariants, ParentThatDoesNotKnowItsChild) {
  map_.Find(Youngest().parent)->children.erase(Youngest().id);
  ExpectBroken();
}

TEST_F(Invariants, ChildOfTwo) {
  const KeyFrameId other = Youngest().parent == KeyFrameId(0) ? KeyFrameId(1) : KeyFrameId(0);
  map_.Find(other)->children.insert(Youngest().id);
  ExpectBroken();
}

TEST_F(Invariants, SecondRoot) {
  map_.Find(Youngest().parent)->children.erase(Youngest().id);
  Youngest().parent = KeyFrameId();
  ExpectBroken();
}

TEST_F(Invariants, CycleOfAncestors) {
  KeyFrame& root = *map_.Find(KeyFrameId(0));
  root.parent = Youngest().id;
  Youngest().children.insert(root.id);
  ExpectBroken();
}

TEST_F(Invariants, OneSidedLoopEdge) {
  Youngest().loop_edges.insert(KeyFrameId(0));
  ExpectBroken();
}

}  // namespace
}  // namespace orbslam::test
