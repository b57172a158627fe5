// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/local_map_tracker.h"

#include <set>

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

class LocalMapTrackerTest : public SyntheticMap {
 protected:
  /// Two keyframes that look a little left and right and share what is between.
  LocalMapTrackerTest() {
    Frame left = SeeAndKnow({So3Exp({0, 0.3, 0}), {0, 0, 0}});
    left_ = AddKeyFrame(&left);
    Frame right = SeeAndKnow({So3Exp({0, -0.3, 0}), {0.02, 0, 0}});
    right_ = AddKeyFrame(&right);
  }

  /// Sees both keyframes' points, and knows some of those that `known` sees; its pose is a few pixels wrong.
  Frame FrameWithFirstPoints(KeyFrameId known) {
    Frame frame = SeeAndKnow(truth_);
    frame.camera_from_world = RandomMotion(&rng_, 0.004, 0.004) * truth_;
    const auto map = map_.Read();
    for (int i = 0; i < frame.features->size(); ++i) {
      MapPointId& id = frame.points[i];
      if (id.IsValid() && (i % 3 != 0 || std::ranges::count(map->Find(known)->points, id) == 0))
        id = MapPointId();
    }
    return frame;
  }
  int NumPointsOnlyIn(KeyFrameId keyframe, const Frame& frame) const {
    const auto map = map_.Read();
    return static_cast<int>(std::ranges::count_if(frame.points, [&](MapPointId id) {
      const MapPoint* point = map->Find(id);
      return point != nullptr && point->NumObservations() == 1 && point->observations[0].keyframe == keyframe;
    }));
  }

  /// As if what is nearer than that had moved a little since it was mapped. Returns its points, ascending.
  std::vector<MapPointId> MoveWhatIsNear(double limit_m) {
    std::vector<MapPointId> moved;
    const auto map = map_.Write();
    for (const MapPoint& point : map->MapPoints()) {
      if ((truth_ * point.position_world).z() < limit_m) moved.push_back(point.id);
    }
    for (const MapPointId id : moved) map->Find(id)->position_world += Eigen::Vector3d(0.015, 0, 0);
    return moved;
  }

  KeyFrameId left_, right_;
  const Rigid3d truth_ = RandomMotion(&rng_, 0.05, 0.05);
  const TrackingOptions options_{.doubt_near_points = true};
  LocalMapTracker tracker_{map_, sensor_, options_};
  const MovingRegion nothing_moves_{sensor_, {}, {}};
  PointCounter counter_;
};

TEST_F(LocalMapTrackerTest, FindsTheNeighboursPointsAndThePose) {
  for (const KeyFrameId known : {left_, right_}) {
    Frame frame = FrameWithFirstPoints(known);
    const KeyFrameId other = known == left_ ? right_ : left_;
    const int num_before = frame.NumPoints();
    ASSERT_EQ(NumPointsOnlyIn(other, frame), 0);
    const LocalMapTracker::Result result = tracker_.Track(nothing_moves_, &frame, &counter_);
    EXPECT_EQ(result.num_inliers, frame.NumPoints());
    EXPECT_GT(result.num_inliers, 2 * num_before);
    EXPECT_GT(NumPointsOnlyIn(other, frame), 50);
    EXPECT_THAT(frame.camera_from_world, Rigid3dNear(truth_, kMaxErrorM, kMaxErrorRad));
    EXPECT_GT(ShareOfRightPoints(frame), 0.99);
  }
}

TEST_F(LocalMapTrackerTest, ReferenceSharesMostPoints) {
  for (const KeyFrameId known : {left_, right_}) {
    Frame frame = FrameWithFirstPoints(known);
    EXPECT_EQ(tracker_.Track(nothing_moves_, &frame, &counter_).reference, known);
  }
}

TEST_F(LocalMapTrackerTest, CountsWhatWasInViewOnceAndWhatWasFound) {
  Frame frame = FrameWithFirstPoints(left_);
  tracker_.Track(nothing_moves_, &frame, &counter_);
  const std::set<MapPointId> found(frame.points.begin(), frame.points.end());
  const std::vector<PointStatistics> counts = counter_.Take();
  EXPECT_GT(std::ssize(counts), frame.NumPoints() - 1);
  for (const PointStatistics& s : counts) {
    EXPECT_EQ(s.times_visible, 1);
    EXPECT_EQ(s.times_found, found.contains(s.point) ? 1 : 0);
  }
}

TEST_F(LocalMapTrackerTest, NoPointIsFoundAtTwoKeypoints) {
  Frame frame = FrameWithFirstPoints(left_);
  tracker_.Track(nothing_moves_, &frame, &counter_);
  std::set<MapPointId> found;
  for (const MapPointId id : frame.points) EXPECT_TRUE(!id.IsValid() || found.insert(id).second);
}

TEST_F(LocalMapTrackerTest, WhatFarPointsDenyIsNotMatchedButNamed) {
  const std::vector<MapPointId> moved = MoveWhatIsNear(2);
  Frame frame = FrameWithFirstPoints(left_);
  const LocalMapTracker::Result result = tracker_.Track(nothing_moves_, &frame, &counter_);
  EXPECT_GT(frame.moving_below_m, 1);
  EXPECT_THAT(frame.camera_from_world, Rigid3dNear(truth_, 0.002, kMaxErrorRad));
  EXPECT_GT(result.near_moving.size(), 50u);
  const auto has_moved = [&](MapPointId id) { return std::ranges::binary_search(moved, id); };
  EXPECT_GT(std::ranges::count_if(result.near_moving, has_moved),
            0.8 * static_cast<double>(result.near_moving.size()));
  EXPECT_LT(std::ranges::count_if(frame.points, has_moved), 0.1 * static_cast<double>(moved.size()));
}

TEST_F(LocalMapTrackerTest, WhatIsNearIsTrustedWhereNothingIsSaidToMove) {
  MoveWhatIsNear(2);
  const TrackingOptions trusting;
  LocalMapTracker tracker(map_, sensor_, trusting);
  Frame frame = FrameWithFirstPoints(left_);
  EXPECT_TRUE(tracker.Track(nothing_moves_, &frame, &counter_).near_moving.empty());
  EXPECT_EQ(frame.moving_below_m, 0);
}

TEST_F(LocalMapTrackerTest, WhatIsNearIsTrustedWhereNothingHasEverMoved) {
  MoveWhatIsNear(2);
  Frame frame = FrameWithFirstPoints(left_);
  frame.may_show_movers = false;
  EXPECT_TRUE(tracker_.Track(nothing_moves_, &frame, &counter_).near_moving.empty());
  EXPECT_EQ(frame.moving_below_m, 0);
}

TEST_F(LocalMapTrackerTest, NothingIsNamedWhereAllRests) {
  Frame frame = FrameWithFirstPoints(left_);
  EXPECT_TRUE(tracker_.Track(nothing_moves_, &frame, &counter_).near_moving.empty());
  EXPECT_EQ(frame.moving_below_m, 0);
}

TEST_F(LocalMapTrackerTest, FrameWithoutPointsHasNoReference) {
  Frame frame = See(truth_);
  const LocalMapTracker::Result result = tracker_.Track(nothing_moves_, &frame, &counter_);
  EXPECT_EQ(result.num_inliers, 0);
  EXPECT_FALSE(result.reference.IsValid());
}

}  // namespace
}  // namespace orbslam::test
