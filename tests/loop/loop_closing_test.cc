// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_closing.h"

#include "loop/ring.h"

namespace orbslam::test {
namespace {

class LoopClosingTest : public Ring, public testing::WithParamInterface<LoopClosing::GlobalBundle> {
 protected:
  void Walk(int from, int to) {
    for (int i = from; i < to; ++i) closing_.Process({Id(i), Epoch()});
  }

  EditTurn turn_;
  LoopClosing closing_{sensor_, LoopOptions(), GetParam(), &places_, &turn_, &map_};
};

TEST_P(LoopClosingTest, ALapIsClosedOnce) {
  const double before_m = WorstErrorM();
  Walk(0, kLap);
  EXPECT_EQ(closing_.num_loops(), 0);
  EXPECT_EQ(WorstErrorM(), before_m);
  Walk(kLap, kLap + kExtra);
  closing_.Finish();
  EXPECT_EQ(closing_.num_loops(), 1);
  EXPECT_LT(WorstErrorM(), before_m / 5);
  EXPECT_EQ(Epoch(), 2u) << "the loop, and global bundle adjustment";
  EXPECT_EQ(NumMixedPoints(), 0);
  ExpectSound();
}

TEST_P(LoopClosingTest, AllKeyFramesAreListed) {
  Walk(0, 3);
  for (int i = 0; i < 3; ++i) EXPECT_NE(places_.Find(Id(i)), nullptr);
  EXPECT_EQ(places_.Find(Id(3)), nullptr);
}

TEST_P(LoopClosingTest, AKeyFrameThatIsGoneIsNoHarm) {
  ASSERT_TRUE(map_.Write()->EraseKeyFrame(Id(2)));
  Walk(0, 4);
  EXPECT_EQ(places_.Find(Id(2)), nullptr);
}

TEST_P(LoopClosingTest, CanBeDestroyedOrGivenUpWhileItAdjusts) {
  Walk(0, kLap + kExtra);
  ASSERT_EQ(closing_.num_loops(), 1);
  closing_.FinishWithin(std::chrono::milliseconds(0));
  ExpectSound();
}

INSTANTIATE_TEST_SUITE_P(GlobalBundle, LoopClosingTest,
                         testing::Values(LoopClosing::GlobalBundle::kInline,
                                         LoopClosing::GlobalBundle::kBeside));

}  // namespace
}  // namespace orbslam::test
