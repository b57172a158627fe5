// SPDX-License-Identifier: GPL-3.0-or-later
// What a map knows of its points: fusion, and what is worked out from observations.
#include "map/random_map.h"

namespace orbslam::test {
namespace {

using testing::ElementsAre;

class MapPointEdits : public testing::Test {
 protected:
  MapPointEdits() {
    for (int i = 0; i < 3; ++i) {
      const KeyFrameId id = map_.AddKeyFrame(FrameId(i), i, RandomMotion(&rng_), RandomFeatures(10, &rng_));
      if (i > 0) map_.ConnectToSpanningTree(id, keyframes_[0]);
      keyframes_.push_back(id);
    }
  }
  MapPointId AddPoint(const std::vector<Observation>& observations) {
    const MapPointId id = map_.AddMapPoint(RandomVector(&rng_, 3), keyframes_[0]);
    for (const auto& [keyframe, keypoint] : observations)
      EXPECT_TRUE(map_.AddObservation(id, keyframe, keypoint));
    map_.RefreshMapPoint(id);
    return id;
  }

  Rng rng_{12};
  const ScalePyramid pyramid_{8, 1.2};
  MapData map_{pyramid_};
  std::vector<KeyFrameId> keyframes_;
};

TEST_F(MapPointEdits, KeypointShowsOnePointAndKeyFrameSeesAPointOnce) {
  const MapPointId first = AddPoint({{keyframes_[0], 3}}), second = AddPoint({{keyframes_[1], 3}});
  EXPECT_FALSE(map_.AddObservation(second, keyframes_[0], 3)) << "taken";
  EXPECT_FALSE(map_.AddObservation(first, keyframes_[0], 4)) << "seen already";
  EXPECT_THAT(FindBrokenInvariants(map_), testing::IsEmpty());
}

TEST_F(MapPointEdits, FusionMovesObservationsAndKeepsTheTargetsOwn) {
  const MapPointId from = AddPoint({{keyframes_[0], 1}, {keyframes_[1], 1}});
  const MapPointId into = AddPoint({{keyframes_[1], 2}, {keyframes_[2], 2}});
  map_.FuseMapPoint(from, into);
  EXPECT_THAT(map_.Find(into)->observations,
              ElementsAre(Observation{keyframes_[0], 1}, Observation{keyframes_[1], 2},
                          Observation{keyframes_[2], 2}));
  EXPECT_FALSE(map_.Find(keyframes_[1])->points[1].IsValid()) << "the duplicate's keypoint is free again";
}

TEST_F(MapPointEdits, FusionAddsUpHowOftenTheyWereSeen) {
  const MapPointId from = AddPoint({{keyframes_[0], 1}}), into = AddPoint({{keyframes_[1], 1}});
  map_.Find(from)->times_visible = 10, map_.Find(from)->times_found = 5;
  map_.Find(into)->times_visible = 7, map_.Find(into)->times_found = 2;
  map_.FuseMapPoint(from, into);
  EXPECT_EQ(map_.Find(into)->times_visible, 17);
  EXPECT_EQ(map_.Find(into)->times_found, 7);
}

TEST_F(MapPointEdits, ResolveFollowsChainsUntilTheLastIsGone) {
  const MapPointId a = AddPoint({{keyframes_[0], 1}}), b = AddPoint({{keyframes_[0], 2}}),
                   c = AddPoint({{keyframes_[0], 3}});
  map_.FuseMapPoint(a, b);
  map_.FuseMapPoint(b, c);
  EXPECT_EQ(map_.Resolve(a), c);
  EXPECT_EQ(map_.Resolve(c), c);
  map_.EraseMapPoint(c);
  EXPECT_FALSE(map_.Resolve(a).IsValid());
  EXPECT_FALSE(map_.Resolve(MapPointId()).IsValid());
}

TEST_F(MapPointEdits, FusionWithItselfOrTheDeadDoesNothing) {
  const MapPointId alive = AddPoint({{keyframes_[0], 1}}), dead = AddPoint({{keyframes_[0], 2}});
  map_.EraseMapPoint(dead);
  map_.FuseMapPoint(alive, alive);
  map_.FuseMapPoint(alive, dead);
  map_.FuseMapPoint(dead, alive);
  EXPECT_NE(map_.Find(alive), nullptr);
  EXPECT_FALSE(map_.Resolve(dead).IsValid());
}

TEST_F(MapPointEdits, RefreshedNormalIsTheMeanDirectionOfView) {
  const MapPointId id = AddPoint({{keyframes_[0], 1}, {keyframes_[2], 4}});
  const MapPoint& point = *map_.Find(id);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int k : {0, 2}) {
    sum += (point.position_world - map_.Find(keyframes_[k])->CenterWorld()).normalized();
  }
  EXPECT_THAT(point.normal_world, MatrixNear(sum.normalized(), 1e-14));
}

TEST_F(MapPointEdits, RefreshedRangeReachesAsFarAsThePyramid) {
  const MapPointId id = AddPoint({{keyframes_[0], 1}});
  const MapPoint& point = *map_.Find(id);
  const KeyFrame& keyframe = *map_.Find(keyframes_[0]);
  const double distance_m = (point.position_world - keyframe.CenterWorld()).norm();
  EXPECT_NEAR(point.max_distance_m / distance_m, pyramid_.Scale(keyframe.features->levels[1]), 1e-12);
  EXPECT_NEAR(point.max_distance_m / point.min_distance_m, pyramid_.Scale(7), 1e-12);
}

TEST_F(MapPointEdits, RefreshedDescriptorIsOneOfTheObservations) {
  const MapPointId id = AddPoint({{keyframes_[0], 1}, {keyframes_[1], 2}, {keyframes_[2], 3}});
  std::vector<Descriptor> seen;
  for (int k = 0; k < 3; ++k) seen.push_back(map_.Find(keyframes_[k])->features->descriptors[k + 1]);
  EXPECT_EQ(std::ranges::count(seen, map_.Find(id)->descriptor), 1);
}

}  // namespace
}  // namespace orbslam::test
