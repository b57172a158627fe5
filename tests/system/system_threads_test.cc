// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <thread>

#include "map/same_map.h"
#include "orbslam/map/invariants.h"
#include "orbslam/map/map_state.h"
#include "system/threaded_run.h"

namespace orbslam::test {
namespace {

// A mapper slowed by a sanitizer leaves few keyframes to hold on to, or to find the way back by: 300 are too
// few.
constexpr int kManyFeatures = 600;

TEST(SystemThreads, EveryFrameIsTrackedWhetherTheMapperIsWaitedForOrNot) {
  for (const RunMode mode : {kDataset, kLive}) {
    System system = MakeSystem(mode, kManyFeatures);
    EXPECT_EQ(TrackFrames(Walk(), 0, Walk().size(), &system), Walk().size());
    system.Shutdown();
    system.AdjustMaps();
    EXPECT_EQ(NumSavedPoses(system), Walk().size());
    EXPECT_GT(system.counts().keyframes, 1);
    EXPECT_FALSE(system.failure().has_value());
  }
}

TEST(SystemThreads, ResetForgetsEverythingAndStartsAgain) {
  System system = MakeSystem(kLive);
  TrackFrames(Walk(), 0, 8, &system);
  system.Reset();
  EXPECT_EQ(system.counts().frames, 0);
  EXPECT_EQ(system.counts().keyframes, 0);
  EXPECT_EQ(system.counts().map_points, 0);
  EXPECT_EQ(TrackFrames(Walk(), 8, 16, &system), 8);
  EXPECT_EQ(NumSavedPoses(system), 8);
}

TEST(SystemThreads, LocalizationLeavesTheMapAsItIs) {
  System system = MakeSystem(kLive, kManyFeatures);
  TrackFrames(Walk(), 0, 15, &system);
  system.ActivateLocalizationMode();
  const MapData before = MapData::FromState(system.map().Read()->Export()).value();
  for (int i = 14; i > 4; --i) {  // walks back, since beyond what is mapped nothing could be tracked
    const RgbdImage image = Walk().ImageAt(i, 2 * Walk()[14].timestamp_s - Walk()[i].timestamp_s + 0.1);
    EXPECT_EQ(system.TrackRgbd(image).state, TrackingState::kOk);
  }
  ExpectSame(*system.map().Read(), before);
  system.DeactivateLocalizationMode();
  const double later_s = 2 * Walk()[14].timestamp_s;
  for (int i = 5; i < Walk().size(); ++i) {
    const RgbdImage image = Walk().ImageAt(i, Walk()[i].timestamp_s + later_s);
    EXPECT_EQ(system.TrackRgbd(image).state, TrackingState::kOk);
  }
  system.Shutdown();
  EXPECT_EQ(NumSavedPoses(system), 15 + 10 + Walk().size() - 5);
  EXPECT_GT(system.map().Read()->last_keyframe_id(), before.last_keyframe_id());
}

TEST(SystemThreads, AnotherThreadSeesASoundMapAtAnyTime) {
  System system = MakeSystem(kLive, kManyFeatures);
  std::atomic<int> num_frames = 0;
  const int last = Walk().size();
  int num_looks = 0;
  std::vector<std::string> broken;
  {
    const std::jthread reader([&] {
      // A look after news each, since readers that never pause would keep writers out.
      for (int seen = 0; seen < last; ++num_looks) {
        num_frames.wait(seen);
        seen = num_frames;
        const auto guard = system.map().Read();
        if (broken.empty()) broken = FindBrokenInvariants(*guard);
      }
    });
    for (int i = 0; i < last; ++i) {
      EXPECT_EQ(TrackFrames(Walk(), i, i + 1, &system), 1);
      num_frames = i + 1;
      num_frames.notify_all();
    }
  }
  EXPECT_THAT(broken, testing::IsEmpty());
  EXPECT_GT(num_looks, 1);
}

TEST(SystemThreads, LoopIsClosedBesideTracking) {
  System system = MakeSystem(kLive);
  EXPECT_EQ(TrackFrames(Round(), 0, Round().size(), &system), Round().size());
  system.Shutdown();
  EXPECT_FALSE(system.failure().has_value());
  EXPECT_GE(system.counts().loops, 1);
  EXPECT_THAT(FindBrokenInvariants(*system.map().Read()), testing::IsEmpty());
  EXPECT_EQ(NumSavedPoses(system), Round().size());
}

TEST(SystemThreads, ShutdownCutsAGlobalBundleAdjustmentShort) {
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
