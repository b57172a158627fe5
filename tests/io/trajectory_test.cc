// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/trajectory.h"

#include <gmock/gmock.h>

#include <limits>

#include "orbslam/util/file.h"
#include "orbslam/util/random.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<StampedPose> RandomTrajectory(int size) {
  Rng rng(3);
  const auto draw = [&] { return rng.Uniform(-1, 1); };
  std::vector<StampedPose> trajectory;
  for (int i = 0; i < size; ++i) {
    const Eigen::Quaterniond rotation(draw(), draw(), draw(), draw());
    trajectory.push_back({"130503110" + std::to_string(i % 10) + ".1753040",
                          {rotation.normalized(), {100 * draw(), draw(), 0.001 * draw()}}});
  }
  return trajectory;
}

TEST(Trajectory, WhatIsWrittenIsReadToNineDecimals) {
  const TempDir dir;
  const std::vector<StampedPose> written = RandomTrajectory(50);
  ASSERT_TRUE(WriteTrajectory(dir.Path("t.txt"), written).ok());
  const auto read = ReadTrajectory(dir.Path("t.txt"));
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read->size(), written.size());
  for (size_t i = 0; i < written.size(); ++i) {
    const Rigid3d& a = written[i].world_from_camera;
    const Rigid3d& b = (*read)[i].world_from_camera;
    EXPECT_EQ((*read)[i].timestamp_text, written[i].timestamp_text);
    EXPECT_LT((a.translation - b.translation).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT(a.rotation.angularDistance(b.rotation), 1e-8);
    EXPECT_GE(b.rotation.w(), 0);
  }
  EXPECT_EQ(dir.NumFiles(), 1);
}

TEST(Trajectory, ALineIsTumsAndDoesNotDependOnTheSignOfTheQuaternion) {
  const TempDir dir;
  const Rigid3d pose{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1, -2.5, 0.125}};
  const Rigid3d same{Eigen::Quaterniond(-0.5, -0.5, 0.5, -0.5), {1, -2.5, 0.125}};
  ASSERT_TRUE(
      WriteTrajectory(dir.Path("t"), std::vector<StampedPose>{{"17.50", pose}, {"17.50", same}}).ok());
  const std::string line =
      "17.50 1.000000000 -2.500000000 0.125000000 0.500000000 -0.500000000 0.500000000 0.500000000\n";
  EXPECT_EQ(*ReadFile(dir.Path("t")), line + line);
}

TEST(Trajectory, CommentsAndLineEndsOfOthersAreAccepted) {
  const TempDir dir;
  const auto read = ReadTrajectory(dir.Write("t", "# time tx\r\n\r\n1.5,1 2\t3 0 0 0 1\r\n"));
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read->size(), 1u);
  EXPECT_EQ(read->front().timestamp_text, "1.5");
  EXPECT_EQ(read->front().world_from_camera.translation, Eigen::Vector3d(1, 2, 3));
}

TEST(Trajectory, BadLinesAreNamed) {
  const TempDir dir;
  const auto error_of = [&](const std::string& line) {
    return ReadTrajectory(dir.Write("t.txt", "#\n" + line)).error().message;
  };
  EXPECT_THAT(error_of("1 0 0 0 0 0 1"), AllOf(HasSubstr("t.txt:2: "), HasSubstr("found 7")));
  EXPECT_THAT(error_of("1 0 0 nan 0 0 0 1"), AllOf(HasSubstr("t.txt:2: "), HasSubstr("'nan'")));
  EXPECT_THAT(error_of("1 0 0 0 0 0 0 2"), AllOf(HasSubstr("t.txt:2: "), HasSubstr("length 2")));
  EXPECT_THAT(ReadTrajectory(dir.Path("none")).error().message, HasSubstr("No such file"));
}

TEST(Trajectory, NothingIsWrittenWhenItCannotBeDoneWell) {
  const TempDir dir;
  std::vector<StampedPose> trajectory = RandomTrajectory(3);
  EXPECT_THAT(WriteTrajectory("/dev/full", trajectory).error().message, HasSubstr("No space left"));
  EXPECT_THAT(WriteTrajectory(dir.Path("none/t"), trajectory).error().message, HasSubstr("none/t"));
  trajectory[1].world_from_camera.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(WriteTrajectory(dir.Path("t"), trajectory).error().message,
              HasSubstr(trajectory[1].timestamp_text));
  EXPECT_EQ(dir.NumFiles(), 0);
}

}  // namespace
}  // namespace orbslam
