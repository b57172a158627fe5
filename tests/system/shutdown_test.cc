// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>

#include "orbslam/util/random.h"
#include "system/threaded_run.h"

namespace orbslam::test {
namespace {

/// Shutdown promises two seconds; a sanitizer may take several times as long for the same work.
std::chrono::duration<double> ShutdownLimit() {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  return std::chrono::seconds(10);
#else
  return std::chrono::seconds(2);
#endif
}

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

TEST(Shutdown, CutsAGlobalBundleAdjustmentShort) {
  System system = MakeSystem(kDataset);
  int num_frames = 0;
  while (num_frames < Round().size() && system.counts().loops == 0) {
    EXPECT_EQ(TrackFrames(Round(), num_frames, num_frames + 1, &system), 1);
    ++num_frames;
  }
  const auto start = std::chrono::steady_clock::now();
  system.Shutdown();
  EXPECT_LT(std::chrono::steady_clock::now() - start, ShutdownLimit());
  EXPECT_EQ(NumSavedPoses(system), num_frames);
}

}  // namespace
}  // namespace orbslam::test
