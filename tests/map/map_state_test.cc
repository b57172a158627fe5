// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/map/map_state.h"

#include <functional>
#include <limits>

#include "map/random_map.h"
#include "map/same_map.h"

namespace orbslam::test {
namespace {

using testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class MapStateTest : public testing::TestWithParam<int> {
 protected:
  MapStateTest() {
    for (int i = 0; i < 2000; ++i) edits_.EditOnce();
    map_.BumpEpoch();
  }

  Rng rng_{static_cast<uint64_t>(GetParam())};
  MapData map_{ScalePyramid(8, 1.2)};
  RandomMap edits_{&map_, &rng_};
};

TEST_P(MapStateTest, BuildsAMapThatIsTheSame) {
  const Result<MapData> built = MapData::FromState(map_.Export());
  ASSERT_TRUE(built.ok()) << built.error().message;
  EXPECT_THAT(FindBrokenInvariants(*built), IsEmpty());
  ExpectSame(map_, *built);
}

TEST_P(MapStateTest, TheBuiltMapGoesOnAsTheOldOneDoes) {
  MapData built = MapData::FromState(map_.Export()).value();
  for (MapData* map : {&map_, &built}) {
    Rng rng(99);
    RandomMap edits(map, &rng);
    for (int i = 0; i < 500; ++i) edits.EditOnce();
  }
  EXPECT_THAT(FindBrokenInvariants(built), IsEmpty());
  ExpectSame(map_, built);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MapStateTest, testing::Range(1, 4));

/// Two keyframes, of which the younger hangs below the older, a culled third, and two points.
MapState SmallState() {
  Rng rng(1);
  MapData map(ScalePyramid(8, 1.2));
  for (uint32_t i = 0; i < 3; ++i) {
    map.AddKeyFrame(FrameId(i), i, RandomMotion(&rng), RandomFeatures(5, &rng));
    if (i > 0) map.ConnectToSpanningTree(KeyFrameId(i), KeyFrameId(0));
  }
  for (int i = 0; i < 4; ++i) {
    const MapPointId point = map.AddMapPoint(RandomVector(&rng, 1), KeyFrameId(0));
    for (uint32_t k = 0; k < 3; ++k) map.AddObservation(point, KeyFrameId(k), i);
  }
  map.AddLoopEdge(KeyFrameId(0), KeyFrameId(1));
  map.FuseMapPoint(MapPointId(2), MapPointId(1));
  map.FuseMapPoint(MapPointId(3), MapPointId(0));
  map.EraseKeyFrame(KeyFrameId(2));
  return map.Export();
}

FrameFeatures& MutableFeatures(MapState& state) {
  auto copy = std::make_shared<FrameFeatures>(*state.keyframes[0].features);
  state.keyframes[0].features = copy;
  return *copy;
}

struct Damage {
  const char* name;
  std::function<void(MapState&)> inflict;
};

const Damage kDamages[] = {
    {"KeyFrameTwice", [](MapState& s) { s.keyframes[1].id = KeyFrameId(0); }},
    {"KeyFrameIdTooGreat", [](MapState& s) { s.keyframes[1].id = KeyFrameId(3); }},
    {"KeyFrameWithoutId", [](MapState& s) { s.keyframes[1].id = KeyFrameId(); }},
    {"KeyFrameForgotten",
     [](MapState& s) {
       s.remains.clear();
       s.keyframes[1].id = KeyFrameId(2);
     }},
    {"RemainsOfTheLiving",
     [](MapState& s) {
       s.remains[KeyFrameId(1)] = {KeyFrameId(0), {}};
     }},
    {"RemainsWithoutParent", [](MapState& s) { s.remains[KeyFrameId(2)].parent = KeyFrameId(); }},
    {"RemainsBelowThemselves", [](MapState& s) { s.remains[KeyFrameId(2)].parent = KeyFrameId(2); }},
    {"RemainsBent", [](MapState& s) { s.remains[KeyFrameId(2)].self_from_parent.rotation.w() = 7; }},
    {"ParentUnknown", [](MapState& s) { s.keyframes[1].parent = KeyFrameId(9); }},
    {"ParentCulled", [](MapState& s) { s.keyframes[1].parent = KeyFrameId(2); }},
    {"ParentsInACircle", [](MapState& s) { s.keyframes[0].parent = KeyFrameId(1); }},
    {"TwoRoots", [](MapState& s) { s.keyframes[1].parent = KeyFrameId(); }},
    {"LoopToNowhere", [](MapState& s) { s.loop_edges[0].second = KeyFrameId(2); }},
    {"LoopToItself", [](MapState& s) { s.loop_edges[0].second = KeyFrameId(0); }},
    {"NoFeatures", [](MapState& s) { s.keyframes[0].features = nullptr; }},
    {"FeaturesOfOtherLengths", [](MapState& s) { MutableFeatures(s).depths_m.pop_back(); }},
    {"FeatureOffTheImage", [](MapState& s) { MutableFeatures(s).pixels[2].x = std::nanf(""); }},
    {"LevelTooHigh", [](MapState& s) { MutableFeatures(s).levels[2] = 8; }},
    {"AngleNegative", [](MapState& s) { MutableFeatures(s).angles_deg[2] = -1e9f; }},
    {"TimeNan", [](MapState& s) { s.keyframes[0].timestamp_s = kNan; }},
    {"PoseNan", [](MapState& s) { s.keyframes[0].camera_from_world.rotation.x() = kNan; }},
    {"MorePointsThanKeypoints", [](MapState& s) { s.keyframes[0].points.emplace_back(); }},
    {"PointTwice", [](MapState& s) { s.points[1].id = MapPointId(0); }},
    {"PointIdTooGreat", [](MapState& s) { s.num_point_ids = 1; }},
    {"PointAtNan", [](MapState& s) { s.points[0].position_world.y() = kNan; }},
    {"PointCreatedByNobody", [](MapState& s) { s.points[0].created_by = KeyFrameId(3); }},
    {"PointFoundTooOften", [](MapState& s) { s.points[0].times_found = std::numeric_limits<int>::max(); }},
    {"PointUnseen",
     [](MapState& s) {
       for (KeyFrame& k : s.keyframes) k.points[0] = MapPointId();
     }},
    {"PointSeenTwice", [](MapState& s) { s.keyframes[0].points[4] = MapPointId(0); }},
    {"PointSeenButGone", [](MapState& s) { s.keyframes[0].points[4] = MapPointId(2); }},
    {"PointSeenButNeverThere", [](MapState& s) { s.keyframes[0].points[4] = MapPointId(77); }},
    {"LivingPointFused", [](MapState& s) { s.fused_into[MapPointId(0)] = MapPointId(1); }},
    {"FusedIntoNothing", [](MapState& s) { s.fused_into[MapPointId(2)] = MapPointId(4); }},
    {"FusedIntoEachOther",
     [](MapState& s) {
       s.fused_into = {{MapPointId(2), MapPointId(3)}, {MapPointId(3), MapPointId(2)}};
     }},
};

class DamagedState : public testing::TestWithParam<Damage> {};

TEST_P(DamagedState, IsRefusedInOneLine) {
  ASSERT_TRUE(MapData::FromState(SmallState()).ok());
  MapState state = SmallState();
  GetParam().inflict(state);
  const Result<MapData> built = MapData::FromState(std::move(state));
  ASSERT_FALSE(built.ok());
  EXPECT_THAT(built.error().message, testing::Not(testing::HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(OfAnyKind, DamagedState, testing::ValuesIn(kDamages),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace orbslam::test
