// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>

#include "orbslam/io/image_file.h"
#include "orbslam/io/rgbd_images.h"
#include "orbslam/io/trajectory.h"
#include "orbslam/io/tum_sequence.h"
#include "orbslam/synthetic/synthetic_sequence.h"
#include "orbslam/util/file.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

namespace fs = std::filesystem;

class MakeSequence : public testing::Test {
 protected:
  /// The exit code; what the program prints is in the file log.
  int Run(const std::string& arguments) const {
    const std::string command = std::string(MAKE_SEQUENCE) + ' ' + arguments + " > " + Path("log") + " 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string Path(const std::string& name) const { return dir_.Path(name); }
  std::string Log() const { return *ReadFile(Path("log")); }

  TempDir dir_;
};

TEST_F(MakeSequence, FilesHoldTheFramesAndTheGroundTruth) {
  ASSERT_EQ(Run("--out " + Path("a") +
                " --motion loop --script walking --frames 4 --width 160 --no-sensor --quiet"),
            0)
      << Log();
  EXPECT_EQ(Log(), "");
  SyntheticSequenceOptions options;
  options.motion = Motion::kLoop;
  options.script = ScriptKind::kWalking;
  options.num_frames = 4;
  options.camera = SyntheticCamera(160);
  const SyntheticSequence expected(options);
  const auto sequence = ReadTumSequence(Path("a"), Path("a/associations.txt"));
  const auto truth = ReadTrajectory(Path("a/groundtruth.txt"));
  ASSERT_TRUE(sequence.ok() && truth.ok());
  ASSERT_EQ(sequence->entries.size(), 4u);
  ASSERT_EQ(truth->size(), 4u);
  EXPECT_TRUE(sequence->warnings.empty());
  for (int i = 0; i < 4; ++i) {
    const SyntheticFrame frame = expected.Frame(i);
    const auto images = LoadRgbd(sequence->entries[i], options.camera, DepthModel(), WithColor::kYes);
    ASSERT_TRUE(images.ok()) << images.error().message;
    EXPECT_EQ(cv::norm(images->bgr, frame.bgr, cv::NORM_INF), 0);
    EXPECT_LE(cv::norm(images->depth_m, frame.depth_m, cv::NORM_INF), 0.501 / 5000);
    EXPECT_NEAR(sequence->entries[i].timestamp_s, frame.timestamp_s, 1e-6);
    const std::string name = sequence->entries[i].timestamp_text + ".png";
    for (const auto& [folder, mask] :
         {std::pair("a/mask/", frame.mask), std::pair("a/mask_moving/", frame.mask_moving)}) {
      const auto written = ReadGray(Path(folder + name));
      ASSERT_TRUE(written.ok());
      EXPECT_EQ(cv::norm(*written, mask, cv::NORM_INF), 0) << folder << name;
    }
    EXPECT_LT(((*truth)[i].world_from_camera.translation - frame.world_from_camera.translation).norm(), 1e-8);
  }
}

TEST_F(MakeSequence, SameSeedGivesTheSameBytes) {
  const std::string arguments = " --frames 3 --width 160 --seed 5";
  ASSERT_EQ(Run("--out " + Path("a") + arguments), 0) << Log();
  ASSERT_EQ(Run("--out " + Path("b") + arguments), 0) << Log();
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(Path("a"))) {
    if (!entry.is_regular_file()) continue;
    const fs::path twin = Path("b") / entry.path().lexically_relative(Path("a"));
    EXPECT_EQ(*ReadFile(entry.path().string()), *ReadFile(twin.string())) << twin;
    ++files;
  }
  EXPECT_EQ(files, 4 * 3 + 6);
}

TEST_F(MakeSequence, ErrorsAreOneLineAndExitCodeTwo) {
  const std::string out = "--out " + Path("a");
  ASSERT_TRUE(WriteFileAtomically(Path("file"), "").ok());
  for (const std::string& arguments :
       {std::string(), out + " --motion waltz", out + " --script opera", out + " --frames -3",
        out + " --frames many", out + " --unknown", "--out " + Path("file") + "/x"}) {
    EXPECT_EQ(Run(arguments), 2) << arguments;
    const std::string log = Log();
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
    EXPECT_EQ(log.find("make_sequence: "), 0u) << log;
  }
}

}  // namespace
}  // namespace orbslam
