// SPDX-License-Identifier: GPL-3.0-or-later
// Laws that hold after any sequence of edits.
#include "map/random_map.h"

namespace orbslam::test {
namespace {

using testing::IsEmpty;

class RandomEdits : public testing::TestWithParam<int> {
 protected:
  Rng rng_{static_cast<uint64_t>(GetParam())};
  MapData map_{ScalePyramid(8, 1.2)};
  RandomMap edits_{&map_, &rng_};
};

TEST_P(RandomEdits, KeepTheInvariants) {
  for (int i = 0; i < 4000; ++i) {
    edits_.EditOnce();
    if (i % 50 != 0) continue;
    ASSERT_THAT(FindBrokenInvariants(map_), IsEmpty()) << "after edit " << i;
  }
  EXPECT_THAT(FindBrokenInvariants(map_), IsEmpty());
  EXPECT_GT(map_.num_keyframes(), 5) << "a map of nothing proves nothing";
  EXPECT_LT(map_.num_keyframes(), static_cast<int>(map_.last_keyframe_id().value)) << "none was ever erased";
  EXPECT_GT(map_.num_points(), 20);
}

TEST_P(RandomEdits, EveryFusedPointResolvesToWhatItsTargetResolvesTo) {
  std::map<MapPointId, MapPointId> fused;
  for (int i = 0; i < 3000; ++i) {
    edits_.EditOnce();
    const MapPointId from = edits_.RandomPoint(), into = edits_.RandomPoint();
    if (i % 4 != 0 || from == into || !from.IsValid()) continue;
    map_.FuseMapPoint(from, into);
    fused[from] = into;
  }
  ASSERT_GT(fused.size(), 100u);
  for (const auto& [from, into] : fused) {
    EXPECT_EQ(map_.Find(from), nullptr);
    EXPECT_EQ(map_.Resolve(from), map_.Resolve(into));
    EXPECT_TRUE(!map_.Resolve(from).IsValid() || map_.Find(map_.Resolve(from)) != nullptr);
  }
}

TEST_P(RandomEdits, IdsAreNeverReused) {
  KeyFrameId last_keyframe;
  MapPointId last_point;
  for (int i = 0; i < 300; ++i) {
    const KeyFrameId keyframe = edits_.AddKeyFrame();
    const MapPointId point = edits_.AddMapPoint();
    EXPECT_TRUE(i == 0 || (keyframe > last_keyframe && point > last_point));
    last_keyframe = map_.last_keyframe_id();
    last_point = point;
    map_.EraseMapPoint(point);
    map_.EraseKeyFrame(keyframe);
  }
}

TEST_P(RandomEdits, IterationIsAscendingAndCountsTheLiving) {
  for (int i = 0; i < 1000; ++i) edits_.EditOnce();
  EXPECT_TRUE(std::ranges::is_sorted(map_.KeyFrames(), {}, &KeyFrame::id));
  EXPECT_TRUE(std::ranges::is_sorted(map_.MapPoints(), {}, &MapPoint::id));
  EXPECT_EQ(std::ranges::distance(map_.KeyFrames()), map_.num_keyframes());
  EXPECT_EQ(std::ranges::distance(map_.MapPoints()), map_.num_points());
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomEdits, testing::Range(1, 6));

}  // namespace
}  // namespace orbslam::test
