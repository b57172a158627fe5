// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>

#include "orbslam/util/random.h"
#include "system/threaded_run.h"

namespace orbslam::test {
namespace {

TEST(Shutdown, FollowsTheStartTwoHundredTimes) {
  for (int i = 0; i < 200; ++i) {
    System system = MakeSystem(i % 2 ? kLive : kDataset);
    ASSERT_EQ(TrackFrames(Walk(), 0, i % 3, &system), i % 3);
    if (i % 4 < 2) system.Shutdown();  // otherwise the destructor has to
  }
}

TEST(Shutdown, IsDoneWithinTheTimePromisedAtAnyFrame) {
  Rng rng(5);
  for (int i = 0; i < 50; ++i) {
    System system = MakeSystem(i % 2 ? kLive : kDataset);
    const int num_frames = static_cast<int>(rng.Uniform(0, 9));
    ASSERT_EQ(TrackFrames(Walk(), 0, num_frames, &system), num_frames);
    const auto start = std::chrono::steady_clock::now();
    system.Shutdown();
    EXPECT_LT(std::chrono::steady_clock::now() - start, ShutdownLimit()) << "after frame " << num_frames;
    EXPECT_EQ(NumSavedPoses(system), num_frames);
    EXPECT_FALSE(system.failure().has_value());
  }
}

}  // namespace
}  // namespace orbslam::test
