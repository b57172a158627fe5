// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/synthetic_run.h"
#include "util/temp_dir.h"

namespace orbslam::test {
namespace {

// Two rounds of the room, 10 frames a second.
const Recording& Rounds() {
  static const Recording recording(Motion::kLoop, 320, 440, /*stride=*/3);
  return recording;
}

// The system is told a focal length that is too long, so it takes every turn for too small, while it has
// nothing else to go by. Too long a depth keeps the size of the map about right.
constexpr double kFocalFactor = 1.01, kDepthFactor = 1.012;

// Each keyframe is followed for long, so that the drift is large beside what the wrong focal length bends.
constexpr double kTrackedRatio = 0.2;

struct Outcome {
  double ate_m = 0;
  System::Counts counts;
};

Outcome WalkWithDrift(RunMode mode, std::shared_ptr<const Vocabulary> vocabulary) {
  Settings settings = SettingsFor(Rounds().camera(), 600);
  settings.keyframes.min_tracked_ratio_all = kTrackedRatio;
  settings.camera.fx *= kFocalFactor;
  settings.camera.fy *= kFocalFactor;
  System system(settings, {.mode = mode, .vocabulary = std::move(vocabulary)});
  for (int i = 0; i < Rounds().size(); ++i) {
    RgbdImage image = Rounds().Image(i);
    image.depth_m = image.depth_m * kDepthFactor;
    EXPECT_EQ(system.TrackRgbd(image).state, TrackingState::kOk) << "frame " << i;
  }
  system.Shutdown();
  EXPECT_FALSE(system.failure().has_value());
  const TempDir dir;
  EXPECT_TRUE(system.SaveTrajectory(dir.Path("camera.txt")).ok());
  return {AteM(dir.Path("camera.txt"), Rounds()), system.counts()};
}

/// Without a vocabulary no loop is closed.
const Outcome& Open() {
  static const Outcome open = WalkWithDrift({.is_sequential = true}, nullptr);
  return open;
}

TEST(LoopClosing, UndoesTheDriftOfAWalkRoundTheRoom) {
  const Outcome& open = Open();
  const Outcome closed = WalkWithDrift({.is_sequential = true}, ShippedVocabulary());
  EXPECT_EQ(open.counts.loops, 0);
  EXPECT_GE(closed.counts.loops, 1);
  EXPECT_GT(open.ate_m, 0.10);
  EXPECT_LT(closed.ate_m, open.ate_m / 5) << "open " << open.ate_m;
  RecordProperty("open_ate_m", std::to_string(open.ate_m));
  RecordProperty("closed_ate_m", std::to_string(closed.ate_m));
}

TEST(LoopClosing, WorksBesideTracking) {
  const Outcome closed = WalkWithDrift({}, ShippedVocabulary());
  EXPECT_GE(closed.counts.loops, 1);
  EXPECT_LT(closed.ate_m, Open().ate_m / 5);
}

}  // namespace
}  // namespace orbslam::test
