// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <iterator>

#include "system/synthetic_run.h"
#include "util/temp_dir.h"

namespace orbslam::test {
namespace {

constexpr RunMode kThreaded{}, kSequential{.is_sequential = true};

const Recording& Swings() {
  static const Recording recording(Motion::kXyz, 640, 150, /*stride=*/2);
  return recording;
}

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Rigid3d> PosesIn(const std::string& path) {
  std::vector<Rigid3d> poses;
  const auto trajectory = ReadTrajectory(path);
  std::ranges::transform(*trajectory, std::back_inserter(poses), &StampedPose::world_from_camera);
  return poses;
}

/// What a run leaves behind in a folder of its own.
struct Outcome {
  explicit Outcome(RunMode mode, double revision_delay_s = TrackingOptions().revision_delay_s,
                   bool detects_motion = true) {
    Settings settings = SettingsFor(Swings().camera(), 500);
    settings.tracking.revision_delay_s = revision_delay_s;
    settings.detects_motion = detects_motion;
    System system(settings, {.mode = mode, .vocabulary = ShippedVocabulary()});
    EXPECT_EQ(TrackFrames(Swings(), 0, Swings().size(), &system), Swings().size());
    system.Shutdown();
    EXPECT_TRUE(system.SaveTrajectory(camera).ok());
    EXPECT_TRUE(system.SaveKeyFrameTrajectory(keyframes).ok());
    EXPECT_TRUE(system.SaveMap(map).ok());
  }

  TempDir dir;
  const std::string camera = dir.Path("camera.txt"), keyframes = dir.Path("keyframes.txt"),
                    map = dir.Path("map");
};

TEST(RepeatableRuns, TwoSequentialRunsAgreeInEveryByte) {
  const Outcome a(kSequential), b(kSequential);
  EXPECT_EQ(Content(a.camera), Content(b.camera));
  EXPECT_EQ(Content(a.keyframes), Content(b.keyframes));
  EXPECT_TRUE(Content(a.map) == Content(b.map));  // binary: not to be printed
}

TEST(RepeatableRuns, WhereNothingMovesTheDetectorChangesNoByte) {
  const Outcome with(kSequential), without(kSequential, TrackingOptions().revision_delay_s, false);
  EXPECT_EQ(Content(with.camera), Content(without.camera));
  EXPECT_TRUE(Content(with.map) == Content(without.map));
}

TEST(RepeatableRuns, LaterPosesAreTheTrajectorysAndLeaveTheMapAlone) {
  const Outcome first(kSequential, /*revision_delay_s=*/0), revised(kSequential);
  const std::vector<Rigid3d> a = PosesIn(first.camera), b = PosesIn(revised.camera);
  ASSERT_EQ(a.size(), b.size());
  const auto num_changed = [&](size_t from, size_t to) {
    int count = 0;
    for (size_t i = from; i < to; ++i) count += (a[i].translation - b[i].translation).norm() > 1e-6;
    return count;
  };
  constexpr size_t kSome = 30;  // less than the delay
  EXPECT_GT(num_changed(0, kSome), kSome / 2);
  EXPECT_GT(num_changed(a.size() - kSome, a.size()), kSome / 2);
  // What has gone since is what makes them better, and here nothing goes.
  EXPECT_LT(AteM(revised.camera, Swings()), 1.1 * AteM(first.camera, Swings()));
  EXPECT_TRUE(Content(first.map) == Content(revised.map));
}

TEST(RepeatableRuns, ThreadsChangeTheTrajectoryByLessThanACentimetre) {
  const Outcome sequential(kSequential), threaded(kThreaded);
  constexpr double kMaxAteM = 0.01;
  EXPECT_LT(AteM(sequential.camera, Swings()), kMaxAteM);
  EXPECT_LT(AteM(threaded.camera, Swings()), kMaxAteM);
  const std::vector<Rigid3d> a = PosesIn(sequential.camera), b = PosesIn(threaded.camera);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LT(AteM(a, b), kMaxAteM);
}

}  // namespace
}  // namespace orbslam::test
