// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/synthetic_run.h"
#include "util/temp_dir.h"

namespace orbslam::test {
namespace {

constexpr int kNumFeatures = 600;
constexpr double kFrameS = 1.0 / 15;
constexpr RunMode kSequential{.is_sequential = true};

/// Half a round; its views change from one corner of the room to the opposite one.
const Recording& Walk() {
  static const Recording recording(Motion::kLoop, 320, 160, /*stride=*/2);
  return recording;
}

SystemOptions Options(std::shared_ptr<const Vocabulary> vocabulary) {
  return {.mode = kSequential, .vocabulary = std::move(vocabulary)};
}

/// Gives the system frames of the walk, in any order, 15 a second.
class Camera {
 public:
  explicit Camera(System* system) : system_(system) {}

  FrameReport Show(int index) { return system_->TrackRgbd(Walk().ImageAt(index, NextTime())); }
  int ShowAll(int first, int last) {
    int num_tracked = 0;
    for (int i = first; i < last; ++i) num_tracked += Show(i).state == TrackingState::kOk;
    return num_tracked;
  }
  /// Returns how many of the black frames were said to be tracked.
  int Cover(double duration_s) {
    int num_tracked = 0;
    for (double s = 0; s < duration_s; s += kFrameS) {
      num_tracked += system_->TrackRgbd(BlackImage(Walk().camera(), NextTime())).state == TrackingState::kOk;
    }
    return num_tracked;
  }

 private:
  double NextTime() { return time_s_ += kFrameS; }

  System* system_;
  double time_s_ = 1.3e9;  // as a clock would say
};

/// Shows frames from `first` on until one is tracked, and how far from where it was tracked the first time;
/// nullopt if none of max_frames is.
std::optional<double> DistanceWhenFoundM(int first, int max_frames, const std::vector<Rigid3d>& first_time,
                                         Camera* camera) {
  for (int i = first; i < first + max_frames; ++i) {
    const FrameReport report = camera->Show(i);
    if (report.world_from_camera)
      return (report.world_from_camera->translation - first_time[i].translation).norm();
  }
  return std::nullopt;
}

class LostAndFound : public testing::TestWithParam<bool> {
 protected:
  std::shared_ptr<const Vocabulary> vocabulary_ = GetParam() ? ShippedVocabulary() : nullptr;
};
INSTANTIATE_TEST_SUITE_P(Vocabulary, LostAndFound, testing::Bool(),
                         [](const auto& with) { return with.param ? "With" : "Without"; });

TEST_P(LostAndFound, KidnappedCameraIsFoundInTheKnownMap) {
  System system(SettingsFor(Walk().camera(), kNumFeatures), Options(vocabulary_));
  Camera camera(&system);
  std::vector<Rigid3d> first_time;
  for (int i = 0; i < Walk().size(); ++i) first_time.push_back(camera.Show(i).world_from_camera.value());
  const int num_keyframes = system.counts().keyframes;
  ASSERT_GT(num_keyframes, SystemOptions().young_map_keyframes);
  for (const int place : {30, 100, 5}) {
    EXPECT_EQ(camera.Cover(/*duration_s=*/2.2), 0);
    const auto distance_m = DistanceWhenFoundM(place, 15, first_time, &camera);
    ASSERT_TRUE(distance_m.has_value()) << "at frame " << place;
    EXPECT_LT(*distance_m, 0.05) << "at frame " << place;
  }
  EXPECT_EQ(system.counts().maps, 1);
}

TEST_P(LostAndFound, YoungMapIsLeftForANewOneAfterTwoSeconds) {
  System system(SettingsFor(Walk().camera(), kNumFeatures), Options(vocabulary_));
  Camera camera(&system);
  ASSERT_EQ(camera.ShowAll(0, 8), 8);
  ASSERT_LE(system.counts().keyframes, SystemOptions().young_map_keyframes);
  EXPECT_EQ(camera.Cover(1.5), 0);
  EXPECT_EQ(system.counts().maps, 1);
  EXPECT_EQ(camera.Cover(1.0), 0);
  EXPECT_EQ(system.counts().maps, 2);
  EXPECT_EQ(camera.ShowAll(100, 130), 30);
  system.Shutdown();

  const TempDir dir;
  ASSERT_TRUE(system.SaveTrajectory(dir.Path("camera.txt")).ok());
  EXPECT_EQ(ReadTrajectory(dir.Path("camera.txt")).value().size(), 30u);  // the largest map
  EXPECT_EQ(ReadTrajectory(dir.Path("camera_2.txt")).value().size(), 8u);
  ASSERT_TRUE(system.SaveKeyFrameTrajectory(dir.Path("keyframes.txt")).ok());
  EXPECT_EQ(dir.NumFiles(), 4);
}

TEST_P(LostAndFound, DepthMayBeMissingForASecond) {
  System system(SettingsFor(Walk().camera(), kNumFeatures), Options(vocabulary_));
  constexpr int kFirst = 20, kLast = 35;  // without depth
  for (int i = 0; i < 60; ++i) {
    RgbdImage image = Walk().Image(i);
    if (i >= kFirst && i < kLast) image.depth_m = cv::Mat::zeros(image.depth_m.size(), CV_32FC1);
    EXPECT_EQ(system.TrackRgbd(image).state, TrackingState::kOk) << i;
  }
  system.Shutdown();
  EXPECT_EQ(system.counts().maps, 1);
  const TempDir dir;
  ASSERT_TRUE(system.SaveTrajectory(dir.Path("camera.txt")).ok());
  EXPECT_LT(AteM(dir.Path("camera.txt"), Walk()), 0.05);
}

TEST_P(LostAndFound, WhoLocalizesOnlyNeverStartsANewMap) {
  System system(SettingsFor(Walk().camera(), kNumFeatures), Options(vocabulary_));
  Camera camera(&system);
  ASSERT_EQ(camera.ShowAll(0, 10), 10);
  system.ActivateLocalizationMode();
  EXPECT_EQ(camera.Cover(3.0), 0);
  EXPECT_EQ(system.counts().maps, 1);
  EXPECT_EQ(camera.ShowAll(2, 8), 6);
}

}  // namespace
}  // namespace orbslam::test
