// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_corrector.h"

#include <future>
#include <thread>

#include "loop/ring.h"

namespace orbslam::test {
namespace {

class LoopCorrectorTest : public Ring {
 protected:
  static constexpr int kCurrent = kLap + 2, kOld = 2;

  LoopCorrectorTest() {
    FillIndex(&places_);
    loop_ = VerifyLoop(options_, sensor_, places_, map_, Id(kCurrent), Id(kOld)).value();
  }
  bool Close() { return CloseLoop(options_, sensor_, loop_, &turn_, &map_); }
  bool Adjust(std::stop_token stop = {}) {
    return AdjustGlobally(options_, sensor_, {}, stop, &turn_, &map_);
  }

  /// Lets global bundle adjustment run up to where it wants the turn, edits the map, and lets it go on.
  template <class Edit>
  bool AdjustWhile(const Edit& edit) {
    std::future<bool> is_applied;
    {
      const auto held = turn_.Take();
      std::promise<void> wants_turn;
      const std::stop_callback asked(held.ShouldYield(), [&] { wants_turn.set_value(); });
      is_applied = std::async(std::launch::async, [this] { return Adjust(); });
      wants_turn.get_future().wait();
      edit();
    }
    return is_applied.get();
  }

  const LoopOptions options_;
  EditTurn turn_;
  Loop loop_;
};

TEST_F(LoopCorrectorTest, ClosingTheLoopTakesTheDriftOut) {
  const double before_m = WorstErrorM();
  ASSERT_GT(before_m, 0.05);
  ASSERT_TRUE(Close());
  EXPECT_LT(WorstErrorM(), before_m / 5);
  EXPECT_THAT(Pose(kCurrent) * Inverse(Pose(kOld)), Rigid3dNear(TrueMotion(kCurrent, kOld), 0.01, 0.005));
  EXPECT_THAT(Pose(0), Rigid3dNear(Truth(0), 0)) << "the world's frame stays where it is";
  EXPECT_EQ(Epoch(), 1u);
  EXPECT_THAT(map_.Read()->Find(loop_.current)->loop_edges, testing::ElementsAre(loop_.old));
  ExpectSound();
}

TEST_F(LoopCorrectorTest, WhatWasMappedTwiceBecomesOne) {
  const int num_before = map_.Read()->num_points();
  std::set<int> early, again;
  for (int i = 0; i < 4; ++i) early.insert(landmarks_of_[i].begin(), landmarks_of_[i].end());
  for (const int l : landmarks_of_[kCurrent]) {
    if (early.contains(l)) again.insert(l);
  }
  ASSERT_TRUE(Close());
  const int num_fused = num_before - map_.Read()->num_points();
  EXPECT_GT(num_fused, 0.8 * static_cast<double>(again.size()));
  EXPECT_EQ(NumMixedPoints(), 0);
  const auto neighbors = map_.Read()->Find(loop_.current)->BestCovisibles(100);
  EXPECT_THAT(neighbors, testing::Contains(loop_.old)) << "both ends see the same points now";
}

TEST_F(LoopCorrectorTest, AKeyFrameThatIsGoneLeavesTheMapAsItIs) {
  loop_.old = KeyFrameId(1000);
  const double before_m = WorstErrorM();
  EXPECT_FALSE(Close());
  EXPECT_EQ(WorstErrorM(), before_m);
  EXPECT_EQ(Epoch(), 0u);
}

TEST_F(LoopCorrectorTest, GlobalBundleAdjustmentImprovesTheClosedLoop) {
  ASSERT_TRUE(Close());
  const double before_m = WorstErrorM();
  ASSERT_TRUE(Adjust());
  EXPECT_LT(WorstErrorM(), before_m);
  EXPECT_EQ(Epoch(), 2u);
  ExpectSound();
}

TEST_F(LoopCorrectorTest, StoppedGlobalBundleAdjustmentChangesNothing) {
  std::stop_source stop;
  stop.request_stop();
  const double before_m = WorstErrorM();
  EXPECT_FALSE(Adjust(stop.get_token()));
  EXPECT_EQ(WorstErrorM(), before_m);
  EXPECT_EQ(Epoch(), 0u);
}

TEST_F(LoopCorrectorTest, GlobalBundleAdjustmentOfAnOlderEpochIsDiscarded) {
  const double before_m = WorstErrorM();
  EXPECT_FALSE(AdjustWhile([&] { map_.Write()->BumpEpoch(); }));
  EXPECT_EQ(WorstErrorM(), before_m);
}

TEST_F(LoopCorrectorTest, WhatWasMappedMeanwhileMovesAlong) {
  ASSERT_TRUE(Close());
  const int last = kLap + kExtra - 1;
  const Rigid3d new_from_last = RandomMotion(&rng_, 0.1, 0.1);
  KeyFrameId added;
  ASSERT_TRUE(AdjustWhile([&] {
    const auto map = map_.Write();
    const KeyFrame& parent = *map->Find(Id(last));
    added = map->AddKeyFrame(FrameId(99), 99, new_from_last * parent.camera_from_world, parent.features);
    map->ConnectToSpanningTree(added, parent.id);
  }));
  EXPECT_THAT(map_.Read()->Find(added)->camera_from_world * Inverse(Pose(last)),
              Rigid3dNear(new_from_last, 1e-9));
  ExpectSound();
}

}  // namespace
}  // namespace orbslam::test
