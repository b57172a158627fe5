// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/map_correction.h"

#include "map/random_map.h"

namespace orbslam::test {
namespace {

class MapCorrectionTest : public testing::TestWithParam<uint64_t> {
 protected:
  MapCorrectionTest() {
    RandomMap editor(&map_, &rng_);
    for (int i = 0; i < 1500; ++i) editor.EditOnce();
    for (const KeyFrame& keyframe : map_.KeyFrames()) before_[keyframe.id] = keyframe.camera_from_world;
    for (const MapPoint& point : map_.MapPoints()) position_before_[point.id] = point.position_world;
  }

  MapCorrection EstimateSome() {
    MapCorrection correction;
    for (const auto& [id, pose] : before_) {
      if (rng_.Below(3) == 0) correction.camera_from_world[id] = RandomMotion(&rng_);
    }
    for (const auto& [id, position] : position_before_) {
      if (rng_.Below(3) == 0) correction.position_world[id] = RandomVector(&rng_, 3);
    }
    return correction;
  }
  Rigid3d Pose(KeyFrameId id) const { return map_.Find(id)->camera_from_world; }

  Rng rng_{GetParam()};
  MapData map_{ScalePyramid(8, 1.2)};
  std::map<KeyFrameId, Rigid3d> before_;
  std::map<MapPointId, Eigen::Vector3d> position_before_;
};

TEST_P(MapCorrectionTest, EstimatesAreTakenAndOtherKeyFramesFollowTheirParents) {
  const MapCorrection correction = EstimateSome();
  CorrectMap(correction, &map_);
  int num_following = 0;
  for (const auto& [id, pose_before] : before_) {
    const auto own = correction.camera_from_world.find(id);
    const KeyFrameId parent = map_.Find(id)->parent;
    if (own != correction.camera_from_world.end()) {
      EXPECT_THAT(Pose(id), Rigid3dNear(own->second, 1e-12));
    } else if (parent.IsValid()) {
      EXPECT_THAT(Pose(id) * Inverse(Pose(parent)),
                  Rigid3dNear(pose_before * Inverse(before_.at(parent)), 1e-9));
      ++num_following;
    } else {
      EXPECT_THAT(Pose(id), Rigid3dNear(pose_before, 0));
    }
  }
  EXPECT_GT(num_following, 5);
}

TEST_P(MapCorrectionTest, PointsMoveWithTheirFirstObserver) {
  const MapCorrection correction = EstimateSome();
  CorrectMap(correction, &map_);
  for (const MapPoint& point : map_.MapPoints()) {
    const auto own = correction.position_world.find(point.id);
    const KeyFrameId first = point.observations.front().keyframe;
    if (own != correction.position_world.end()) {
      EXPECT_EQ(point.position_world, own->second);
    } else {
      EXPECT_THAT(Pose(first) * point.position_world,
                  MatrixNear(before_.at(first) * position_before_.at(point.id), 1e-9));
    }
    const double distance_m = (point.position_world - map_.Find(first)->CenterWorld()).norm();
    EXPECT_GE(point.max_distance_m, (1 - 1e-9) * distance_m) << "the range of distances is not up to date";
  }
}

TEST_P(MapCorrectionTest, ThatChangesNothingChangesNothing) {
  MapCorrection as_it_is{before_, position_before_};
  for (const MapCorrection& correction : {MapCorrection(), as_it_is}) {
    CorrectMap(correction, &map_);
    for (const auto& [id, pose] : before_) EXPECT_THAT(Pose(id), Rigid3dNear(pose, 1e-9));
    for (const auto& [id, position] : position_before_) {
      EXPECT_THAT(map_.Find(id)->position_world, MatrixNear(position, 1e-9));
    }
  }
}

TEST_P(MapCorrectionTest, CountsAnEpochAndKeepsTheInvariants) {
  const uint64_t epoch = map_.epoch();
  CorrectMap(EstimateSome(), &map_);
  EXPECT_EQ(map_.epoch(), epoch + 1);
  EXPECT_THAT(FindBrokenInvariants(map_), testing::IsEmpty());
}

TEST_P(MapCorrectionTest, CulledKeyFramesFollowToo) {
  const KeyFrameId last = map_.last_keyframe_id();
  std::map<KeyFrameId, Rigid3d> from_heir;
  const auto relative_to_heir = [&](KeyFrameId id) {
    return *map_.CameraFromWorld(id) * Inverse(Pose(map_.Resolve(id)));
  };
  for (KeyFrameId id(0); id < last; ++id.value) {
    if (map_.Find(id) == nullptr) from_heir[id] = relative_to_heir(id);
  }
  ASSERT_FALSE(from_heir.empty());
  CorrectMap(EstimateSome(), &map_);
  for (const auto& [id, pose] : from_heir) EXPECT_THAT(relative_to_heir(id), Rigid3dNear(pose, 1e-9));
}

TEST(MapCorrection, FollowsAVeryDeepTree) {
  Rng rng(3);
  MapData map(ScalePyramid(8, 1.2));
  const auto features = RandomFeatures(1, &rng);
  KeyFrameId last;
  for (uint32_t i = 0; i < 20000; ++i) {
    const KeyFrameId id = map.AddKeyFrame(FrameId(i), i, Rigid3d(), features);
    if (i > 0) map.ConnectToSpanningTree(id, last);
    last = id;
  }
  const Rigid3d moved = RandomMotion(&rng);
  CorrectMap({.camera_from_world = {{KeyFrameId(0), moved}}}, &map);
  EXPECT_THAT(map.Find(last)->camera_from_world, Rigid3dNear(moved, 1e-6));
}

INSTANTIATE_TEST_SUITE_P(Seeds, MapCorrectionTest, testing::Values(1, 2, 3));

}  // namespace
}  // namespace orbslam::test
