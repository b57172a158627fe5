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
  explicit Outcome(RunMode mode) {
    System system(SettingsFor(Swings().camera(), 500), {.mode = mode, .vocabulary = ShippedVocabulary()});
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
