// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_verifier.h"

#include "loop/ring.h"

namespace orbslam::test {
namespace {

class LoopVerifierTest : public Ring {
 protected:
  LoopVerifierTest() { FillIndex(&places_); }
  std::optional<Loop> Verify(int current, int old) const {
    return VerifyLoop(options_, sensor_, places_, map_, Id(current), Id(old));
  }
  const LoopOptions options_;
};

TEST_F(LoopVerifierTest, FindsTheMotionBetweenTwoViewsOfAPlaceInSpiteOfTheDrift) {
  for (int current = kLap; current < kLap + kExtra; ++current) {
    for (const int old : {current - kLap, current - kLap + 1}) {
      const auto loop = Verify(current, old);
      ASSERT_TRUE(loop) << current << " and " << old;
      EXPECT_EQ(loop->current, Id(current));
      EXPECT_EQ(loop->old, Id(old));
      EXPECT_THAT(loop->current_from_old, Rigid3dNear(TrueMotion(current, old), 0.02, 0.01));
      EXPECT_GT((Pose(current) * Inverse(Pose(old)) * Inverse(loop->current_from_old)).translation.norm(),
                0.04)
          << "there was no drift to see through";
    }
  }
}

TEST_F(LoopVerifierTest, MatchesAreOfTheSameLandmark) {
  const auto loop = Verify(kLap + 2, 2);
  ASSERT_TRUE(loop);
  EXPECT_GE(std::ssize(loop->points), options_.min_total_matches);
  EXPECT_TRUE(std::ranges::is_sorted(loop->points, std::ranges::less_equal{}, &LoopPoint::keypoint));
  const auto map = map_.Read();
  for (const auto& [keypoint, point] : loop->points) {
    EXPECT_EQ(LandmarkAt(*map, {loop->current, keypoint}),
              LandmarkAt(*map, map->Find(point)->observations.front()));
  }
}

TEST_F(LoopVerifierTest, UnrelatedPlacesAreRefused) {
  for (int old = 6; old < kLap - 6; ++old) EXPECT_FALSE(Verify(kLap, old)) << old;
}

TEST_F(LoopVerifierTest, UnknownOnesAreRefused) {
  EXPECT_FALSE(Verify(kLap, 1000));
  EXPECT_FALSE(Verify(1000, 0));
  places_.Remove(Id(0));
  EXPECT_FALSE(Verify(kLap, 0)) << "its words are not known";
  ASSERT_TRUE(map_.Write()->EraseKeyFrame(Id(1)));
  EXPECT_FALSE(Verify(kLap + 1, 1)) << "was culled";
}

}  // namespace
}  // namespace orbslam::test
