// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/map_bundle.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

class MapBundleTest : public SyntheticMap {
 protected:
  MapBundleTest() {
    for (int i = 0; i < 5; ++i) {
      Frame frame = SeeAndKnow({So3Exp({0, 0.1 * i, 0}), RandomVector(&rng_, 0.05)});
      AddKeyFrame(&frame);
    }
  }
  MapBundle Gather(const std::set<KeyFrameId>& moving, int max_fixed = 100) {
    return GatherBundle(*map_.Read(), sensor_, moving, max_fixed);
  }
  bool Apply(const MapBundle& bundle, const BundleSummary& summary) {
    return ApplyBundle(bundle, summary, &*map_.Write());
  }
  static BundleSummary AllInliers(const MapBundle& bundle) {
    return {.is_inlier = std::vector<char>(bundle.problem.observations.size(), 1), .is_usable = true};
  }
  /// As a solver might: everything that may move, moves.
  void Move(MapBundle* bundle) {
    for (BundlePose& pose : bundle->problem.poses) {
      if (!pose.is_fixed) pose.camera_from_world = RandomMotion(&rng_, 0.01, 0.01) * pose.camera_from_world;
    }
    for (Eigen::Vector3d& point : bundle->problem.points) point += RandomVector(&rng_, 0.01);
  }
  Rigid3d Pose(KeyFrameId id) const { return map_.Read()->Find(id)->camera_from_world; }

  const KeyFrameId root_{0}, a_{2}, b_{3}, other_{4};
  const std::set<KeyFrameId> moving_{a_, b_};
};

TEST_F(MapBundleTest, HoldsExactlyWhatTheMovingKeyFramesSee) {
  const MapBundle bundle = Gather(moving_);
  std::set<MapPointId> expected;
  for (const KeyFrameId id : moving_) {
    for (const MapPointId point : PointsOf(id)) expected.insert(point);
  }
  EXPECT_EQ(std::set(bundle.points.begin(), bundle.points.end()), expected);
  EXPECT_EQ(bundle.points.size(), expected.size());
  size_t num_observations = 0;
  for (const MapPointId id : expected) num_observations += map_.Read()->Find(id)->observations.size();
  EXPECT_EQ(bundle.problem.observations.size(), num_observations);
  for (const BundleObservation& o : bundle.problem.observations) {
    const Eigen::Vector3d x = bundle.problem.poses[o.pose].camera_from_world * bundle.problem.points[o.point];
    const double chi2 = sensor_.intrinsics.ReprojectionError(x, o.pixel).squaredNorm() * o.inverse_variance;
    EXPECT_LT(chi2, 9) << "who is who is mixed up";
  }
}

TEST_F(MapBundleTest, OnlyTheAskedForMoveAndNeverTheRoot) {
  for (const auto& moving : {moving_, std::set<KeyFrameId>{root_, a_}}) {
    const MapBundle bundle = Gather(moving);
    EXPECT_EQ(bundle.keyframes.size(), 5u);
    for (size_t i = 0; i < bundle.keyframes.size(); ++i) {
      const KeyFrameId id = bundle.keyframes[i];
      EXPECT_EQ(!bundle.problem.poses[i].is_fixed, moving.contains(id) && id != root_);
      EXPECT_THAT(bundle.problem.poses[i].camera_from_world, Rigid3dNear(Pose(id), 0));
    }
  }
}

TEST_F(MapBundleTest, FewFixedKeyFramesAreThoseWithMostObservations) {
  std::map<KeyFrameId, int> count;
  for (const MapPointId id : Gather(moving_).points) {
    const auto map = map_.Read();
    for (const Observation& o : map->Find(id)->observations) ++count[o.keyframe];
  }
  const MapBundle bundle = Gather(moving_, 1);
  ASSERT_EQ(bundle.keyframes.size(), 3u);
  for (const KeyFrameId left_out : {root_, KeyFrameId(1), other_}) {
    EXPECT_LE(count[left_out], count[bundle.keyframes[2]]);
  }
  for (const BundleObservation& o : bundle.problem.observations) EXPECT_LT(o.pose, 3);
}

TEST_F(MapBundleTest, ResultsAreWrittenBack) {
  MapBundle bundle = Gather(moving_);
  Move(&bundle);
  ASSERT_TRUE(Apply(bundle, AllInliers(bundle)));
  const auto map = map_.Read();
  for (size_t i = 0; i < bundle.keyframes.size(); ++i) {
    EXPECT_THAT(map->Find(bundle.keyframes[i])->camera_from_world,
                Rigid3dNear(bundle.problem.poses[i].camera_from_world, 0));
  }
  for (size_t i = 0; i < bundle.points.size(); ++i) {
    EXPECT_EQ(map->Find(bundle.points[i])->position_world, bundle.problem.points[i]);
  }
  EXPECT_THAT(FindBrokenInvariants(*map), testing::IsEmpty());
}

TEST_F(MapBundleTest, OutliersAreNoLongerObserved) {
  const MapBundle bundle = Gather(moving_);
  BundleSummary summary = AllInliers(bundle);
  std::set<std::pair<MapPointId, KeyFrameId>> outliers, inliers;
  for (size_t i = 0; i < summary.is_inlier.size(); ++i) {
    const BundleObservation& o = bundle.problem.observations[i];
    summary.is_inlier[i] = rng_.Below(4) > 0;
    (summary.is_inlier[i] ? inliers : outliers).emplace(bundle.points[o.point], bundle.keyframes[o.pose]);
  }
  ASSERT_TRUE(Apply(bundle, summary));
  const auto map = map_.Read();
  const auto is_seen = [&](const std::pair<MapPointId, KeyFrameId>& o) {
    return std::ranges::count(map->Find(o.second)->points, o.first) > 0;
  };
  EXPECT_TRUE(std::ranges::none_of(outliers, is_seen));
  EXPECT_TRUE(std::ranges::all_of(inliers, is_seen));
  EXPECT_THAT(FindBrokenInvariants(*map), testing::IsEmpty());
}

TEST_F(MapBundleTest, OlderEpochsAndFailuresAreRefused) {
  MapBundle bundle = Gather(moving_);
  Move(&bundle);
  BundleSummary failed = AllInliers(bundle);
  failed.is_usable = false;
  const Rigid3d before = Pose(a_);
  EXPECT_FALSE(Apply(bundle, failed));
  map_.Write()->BumpEpoch();
  EXPECT_FALSE(Apply(bundle, AllInliers(bundle)));
  EXPECT_THAT(Pose(a_), Rigid3dNear(before, 0));
}

TEST_F(MapBundleTest, WhatIsGoneMeanwhileIsPassedOver) {
  MapBundle bundle = Gather(moving_);
  Move(&bundle);
  {
    const auto map = map_.Write();
    ASSERT_TRUE(map->EraseKeyFrame(b_));
    for (int i = 0; i < 50; ++i) map->EraseMapPoint(bundle.points[i]);
    for (int i = 50; i < 100; ++i) map->FuseMapPoint(bundle.points[i], bundle.points[i + 50]);
  }
  BundleSummary summary = AllInliers(bundle);
  for (size_t i = 0; i < summary.is_inlier.size(); i += 3) summary.is_inlier[i] = 0;
  EXPECT_TRUE(Apply(bundle, summary));
  EXPECT_EQ(map_.Read()->Find(b_), nullptr);
  const auto moved = std::ranges::find(bundle.keyframes, a_) - bundle.keyframes.begin();
  EXPECT_THAT(Pose(a_), Rigid3dNear(bundle.problem.poses[moved].camera_from_world, 0));
  ExpectSound();
}

TEST_F(MapBundleTest, AFrameThatIsNoKeyFrameAddsWhatItSaw) {
  const Rigid3d truth{So3Exp({0, 0.12, 0}), {0.02, 0, 0}};
  Frame frame = SeeAndKnow(truth);
  const PastFrame past{frame.id, frame.timestamp_s, a_, truth * Inverse(Pose(a_)), {}, SightingsOf(frame)};
  const MapBundle before = Gather(moving_);
  MapBundle bundle = before;
  AddFrame(*map_.Read(), sensor_, past, &bundle);
  EXPECT_EQ(bundle.keyframes, before.keyframes);
  ASSERT_EQ(bundle.problem.poses.size(), before.problem.poses.size() + 1);
  EXPECT_FALSE(bundle.problem.poses.back().is_fixed);
  EXPECT_THAT(bundle.problem.poses.back().camera_from_world, Rigid3dNear(truth, 1e-9, 1e-9));
  const std::set<MapPointId> points(bundle.points.begin(), bundle.points.end());
  const auto num_shared =
      std::ranges::count_if(past.sightings, [&](const Sighting& s) { return points.contains(s.point); });
  EXPECT_GT(num_shared, 50);
  EXPECT_LT(num_shared, std::ssize(past.sightings)) << "it also sees what the bundle is not about";
  ASSERT_EQ(std::ssize(bundle.problem.observations), std::ssize(before.problem.observations) + num_shared);
  for (size_t i = before.problem.observations.size(); i < bundle.problem.observations.size(); ++i) {
    const BundleObservation& o = bundle.problem.observations[i];
    const Eigen::Vector3d x = truth * bundle.problem.points[o.point];
    EXPECT_LT(sensor_.intrinsics.ReprojectionError(x, o.pixel).squaredNorm() * o.inverse_variance, 9);
  }
}

TEST_F(MapBundleTest, WhatOtherFramesGotWrongIsNotTakenFromTheMap) {
  Frame frame = SeeAndKnow(Pose(a_));
  MapBundle bundle = Gather(moving_);
  BundleSummary summary = AllInliers(bundle);
  const PastFrame past{frame.id, frame.timestamp_s, a_, Rigid3d(), {}, SightingsOf(frame)};
  AddFrame(*map_.Read(), sensor_, past, &bundle);
  summary.is_inlier.resize(bundle.problem.observations.size(), 0);
  const auto num_observations = [&] {
    size_t sum = 0;
    for (const MapPoint& point : map_.Read()->MapPoints()) sum += point.observations.size();
    return sum;
  };
  const size_t before = num_observations();
  EXPECT_TRUE(Apply(bundle, summary));
  EXPECT_EQ(num_observations(), before);
}

TEST_F(MapBundleTest, AFrameOfAnUnknownKeyFrameAddsNothing) {
  const Frame frame = SeeAndKnow(Pose(a_));
  MapBundle bundle = Gather(moving_);
  const size_t num_poses = bundle.problem.poses.size();
  AddFrame(*map_.Read(), sensor_, {frame.id, 0, KeyFrameId(77), Rigid3d(), {}, SightingsOf(frame)}, &bundle);
  EXPECT_EQ(bundle.problem.poses.size(), num_poses);
}

}  // namespace
}  // namespace orbslam::test
