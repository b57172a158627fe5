// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/mapping/local_mapping.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

/// Keyframes along a short path whose poses, and hence points, are a little off, as tracking leaves them.
class LocalMappingTest : public SyntheticMap {
 protected:
  struct MapError {
    double poses_m, points_m;  // of camera centres: root mean square; of points: median
  };

  void AddKeyFrames(int count) {
    for (int i = 0; i < count; ++i) {
      truth_.push_back({So3Exp({0, 0.04 * i, 0}), {-0.1 * i, 0.01 * i, 0}});
      Frame frame = SeeAndKnow(truth_.back());
      if (i > 0) {
        frame.camera_from_world =
            Rigid3d{So3Exp(RandomVector(&rng_, 0.001)), RandomVector(&rng_, 0.005)} * truth_.back();
      }
      keyframes_.push_back(AddKeyFrame(&frame));
    }
    const auto map = map_.Write();
    for (MapPoint& point : map->MutableMapPoints()) point.position_world += RandomVector(&rng_, 0.02);
  }

  MapError Error() const {
    const auto map = map_.Read();
    double poses_m2 = 0;
    for (const KeyFrame& keyframe : map->KeyFrames()) {
      const Eigen::Vector3d truth = Inverse(truth_[keyframe.frame_id.value]).translation;
      poses_m2 += (keyframe.CenterWorld() - truth).squaredNorm();
    }
    std::vector<double> points_m;
    for (const MapPoint& point : map->MapPoints()) {
      const int landmark = LandmarkAt(*map, point.observations.front());
      points_m.push_back((point.position_world - landmarks_[landmark].position_world).norm());
    }
    std::ranges::sort(points_m);
    return {std::sqrt(poses_m2 / map->num_keyframes()), points_m[points_m.size() / 2]};
  }

  void Process(bool more_waiting = false, std::stop_token stop = {}) {
    for (const KeyFrameId id : keyframes_) {
      const KeyFrameMapped mapped = mapping_.Process({id, {}}, more_waiting, stop);
      EXPECT_EQ(mapped.keyframe, id);
      EXPECT_EQ(mapped.epoch, 0u);
      ExpectSound();
    }
  }

  std::vector<Rigid3d> truth_;  // index: frame id; camera_from_world
  std::vector<KeyFrameId> keyframes_;
  LocalMapping mapping_{sensor_, MappingOptions(), &map_};
};

TEST_F(LocalMappingTest, PosesAndPointsComeNearerToTheTruth) {
  AddKeyFrames(7);
  const MapError before = Error();
  Process();
  EXPECT_LT(Error().poses_m, before.poses_m / 3);
  EXPECT_LT(Error().points_m, before.points_m / 2);
  EXPECT_EQ(NumMixedPoints(), 0);
  EXPECT_THAT(map_.Read()->Find(keyframes_[0])->camera_from_world, Rigid3dNear(truth_[0], 0))
      << "the world's frame stays where it is";
}

TEST_F(LocalMappingTest, AskedToStopItStillLeavesASoundMap) {
  AddKeyFrames(7);
  const MapError before = Error();
  std::stop_source stop;
  stop.request_stop();
  Process(false, stop.get_token());
  EXPECT_LT(Error().poses_m, 1.1 * before.poses_m);
  EXPECT_LT(Error().points_m, 1.1 * before.points_m);
}

TEST_F(LocalMappingTest, WithoutAnyDepthThreeKeyFramesMustAgree) {
  AddKeyFrames(6);
  for (const KeyFrameId id : keyframes_) ForgetDepths(id);
  Process();
  const auto map = map_.Read();
  EXPECT_GT(map->num_points(), 100);
  EXPECT_GE(std::ranges::min(map->MapPoints(), {}, &MapPoint::NumObservations).NumObservations(), 3);
}

TEST_F(LocalMappingTest, WithMoreWaitingPosesAreLeftForLater) {
  AddKeyFrames(5);
  const MapError before = Error();
  Process(/*more_waiting=*/true);
  EXPECT_EQ(Error().poses_m, before.poses_m);
  EXPECT_EQ(map_.Read()->num_keyframes(), 5);
}

TEST_F(LocalMappingTest, CountsWhatTrackingSaw) {
  AddKeyFrames(3);
  const MapPointId point = PointsOf(keyframes_[0]).front();
  const int seen_before = map_.Read()->Find(point)->times_visible;
  const int found_before = map_.Read()->Find(point)->times_found;
  mapping_.Process({keyframes_[2], {{point, 7, 5}, {MapPointId(99999), 1, 1}}}, true);
  EXPECT_EQ(map_.Read()->Find(point)->times_visible, seen_before + 7);
  EXPECT_EQ(map_.Read()->Find(point)->times_found, found_before + 5);
}

TEST_F(LocalMappingTest, YoungPointsThatAreNotFoundAgainAreErased) {
  AddKeyFrames(3);
  const std::vector<MapPointId> points = PointsOf(keyframes_[2]);
  const MapPointId point = *std::ranges::max_element(points);  // the youngest
  mapping_.Process({keyframes_[2], {{point, 50, 0}}}, true);
  EXPECT_EQ(map_.Read()->Find(point), nullptr);
}

TEST_F(LocalMappingTest, AKeyFrameThatIsGoneIsNoHarm) {
  AddKeyFrames(4);
  ASSERT_TRUE(map_.Write()->EraseKeyFrame(keyframes_[2]));
  Process();
}

}  // namespace
}  // namespace orbslam::test
