// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/point_fusion.h"

#include <set>

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

constexpr double kRadiusPx = 3;

class PointFusionTest : public SyntheticMap {
 protected:
  PointFusionTest() {
    Frame frame = SeeAndKnow(Rigid3d());
    first_ = AddKeyFrame(&frame);
    points_of_first_ = point_of_;
  }

  /// Keyframe of a camera that does not recognise anything: it makes its own points.
  KeyFrameId AddStranger() {
    const Rigid3d camera_from_world = RandomMotion(&rng_, 0.05, 0.1);
    Frame frame = See(camera_from_world);
    frame.camera_from_world = camera_from_world;
    return AddKeyFrame(&frame);
  }

  std::set<int> LandmarksOf(KeyFrameId keyframe) const {
    const auto map = map_.Read();
    const auto& landmarks = landmarks_of_[map->Find(keyframe)->frame_id.value];
    return {landmarks.begin(), landmarks.end()};
  }
  int NumShared(KeyFrameId a, KeyFrameId b) const {
    const std::set<int> in_a = LandmarksOf(a), in_b = LandmarksOf(b);
    return static_cast<int>(std::ranges::count_if(in_a, [&](int l) { return in_b.contains(l); }));
  }

  KeyFrameId first_;
  std::map<int, MapPointId> points_of_first_;  // by landmark
};

TEST_F(PointFusionTest, DuplicatesBecomeOneAndNothingElseDoes) {
  const KeyFrameId second = AddStranger();
  const int num_shared = NumShared(first_, second), num_before = map_.Read()->num_points();
  const int num_fused = FusePoints(sensor_, second, PointsOf(first_), kRadiusPx, &map_);
  EXPECT_GT(num_fused, 0.95 * num_shared);
  EXPECT_LE(num_fused, num_shared);
  EXPECT_EQ(map_.Read()->num_points(), num_before - num_fused);
  EXPECT_EQ(NumMixedPoints(), 0);
  ExpectSound();
  EXPECT_EQ(FusePoints(sensor_, second, PointsOf(first_), kRadiusPx, &map_), 0) << "they are one already";
}

TEST_F(PointFusionTest, FusedIdsStandForTheSurvivor) {
  const KeyFrameId second = AddStranger();
  FusePoints(sensor_, second, PointsOf(first_), kRadiusPx, &map_);
  const auto map = map_.Read();
  int num_same = 0;
  for (const auto& [landmark, point] : point_of_) {
    const auto first = points_of_first_.find(landmark);
    if (first == points_of_first_.end()) continue;
    ASSERT_TRUE(map->Resolve(point).IsValid());
    num_same += map->Resolve(point) == map->Resolve(first->second);
  }
  EXPECT_GT(num_same, 0.95 * NumShared(first_, second));
}

TEST_F(PointFusionTest, KeypointsWithoutAPointGetIt) {
  const KeyFrameId second = AddStranger();
  for (const MapPointId id : PointsOf(second)) map_.Write()->RemoveObservation(id, second);
  const int num_before = map_.Read()->num_points(), num_shared = NumShared(first_, second);
  const int num_found = FusePoints(sensor_, second, PointsOf(first_), kRadiusPx, &map_);
  EXPECT_GT(num_found, 0.95 * num_shared);
  EXPECT_EQ(std::ssize(PointsOf(second)), num_found);
  EXPECT_EQ(map_.Read()->num_points(), num_before) << "nothing was fused";
  EXPECT_EQ(NumMixedPoints(), 0);
  ExpectSound();
}

TEST_F(PointFusionTest, ThePointThatMoreSeeSurvives) {
  for (int i = 0; i < 2; ++i) {
    Frame frame = SeeAndKnow(RandomMotion(&rng_, 0.05, 0.1));
    AddKeyFrame(&frame);
  }
  std::vector<MapPointId> well_seen = PointsOf(first_);
  std::erase_if(well_seen, [&](MapPointId id) { return map_.Read()->Find(id)->NumObservations() < 2; });
  const KeyFrameId stranger = AddStranger();  // sees everything alone
  EXPECT_GT(FusePoints(sensor_, first_, PointsOf(stranger), kRadiusPx, &map_), 100);
  for (const MapPointId id : well_seen) EXPECT_EQ(map_.Read()->Resolve(id), id);
  ExpectSound();
}

TEST_F(PointFusionTest, PointsInTheWrongPlaceStayApart) {
  const KeyFrameId second = AddStranger();
  const std::vector<MapPointId> moved = PointsOf(first_);
  for (const MapPointId id : moved) {
    map_.Write()->Find(id)->position_world += 0.5 * RandomDirection(&rng_);
  }
  EXPECT_LT(FusePoints(sensor_, second, moved, kRadiusPx, &map_), 0.02 * NumShared(first_, second));
  ExpectSound();
}

TEST_F(PointFusionTest, IdsThatAreGoneArePassedOver) {
  const std::vector<MapPointId> gone{MapPointId(), MapPointId(100000)};
  EXPECT_EQ(FusePoints(sensor_, first_, gone, kRadiusPx, &map_), 0);
  EXPECT_EQ(FusePoints(sensor_, KeyFrameId(9), PointsOf(first_), kRadiusPx, &map_), 0);
  EXPECT_EQ(FusePoints(sensor_, first_, {}, kRadiusPx, &map_), 0);
}

}  // namespace
}  // namespace orbslam::test
