// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include "map/same_map.h"
#include "system/synthetic_run.h"
#include "util/temp_dir.h"

namespace orbslam::test {
namespace {

constexpr double kLaterS = 1.3e9;  // a clock's time, hours after what is in the map

const Recording& Walk() {
  static const Recording recording(Motion::kLoop, 320, 100, /*stride=*/2);
  return recording;
}

Settings SettingsOfWalk() { return SettingsFor(Walk().camera(), 600); }

class SavedMap : public testing::Test {
 protected:
  void MapFrames(int num_frames) {
    System mapper(SettingsOfWalk(), options_);
    first_time_.clear();
    for (int i = 0; i < num_frames; ++i) {
      first_time_.push_back(mapper.TrackRgbd(Walk().Image(i)).world_from_camera.value());
    }
    ASSERT_TRUE(mapper.SaveMap(path_).ok());
  }
  /// Tracks frames first .. last-1 in the saved map; returns how many have a pose within 5 cm of that at the
  /// time of mapping (if they were shown then).
  int Localize(int first, int last, System* system) {
    int num_right = 0;
    for (int i = first; i < last; ++i) {
      const auto report = system->TrackRgbd(Walk().ImageAt(i, kLaterS + Walk()[i].timestamp_s));
      if (!report.world_from_camera) continue;
      num_right += i >= std::ssize(first_time_) ||
                   (report.world_from_camera->translation - first_time_[i].translation).norm() < 0.05;
    }
    return num_right;
  }

  const TempDir dir_;
  const std::string path_ = dir_.Path("room.map");
  std::vector<Rigid3d> first_time_;
  const SystemOptions options_{.vocabulary = ShippedVocabulary()};
};

TEST_F(SavedMap, IsLocalizedInFromTheFirstFrames) {
  MapFrames(Walk().size());
  System system(SettingsOfWalk(), options_);
  system.ActivateLocalizationMode();
  ASSERT_TRUE(system.LoadMap(path_).ok());
  const MapData before = MapData::FromState(system.map().Read()->Export()).value();
  constexpr int kFirst = 40, kMaxFramesToFind = 3;
  EXPECT_GE(Localize(kFirst, 95, &system), 95 - kFirst - kMaxFramesToFind);
  ExpectSame(*system.map().Read(), before);
}

TEST_F(SavedMap, IsExtendedWhenMappingGoesOn) {
  MapFrames(50);
  System system(SettingsOfWalk(), options_);
  ASSERT_TRUE(system.LoadMap(path_).ok());
  const int num_keyframes = system.counts().keyframes;
  EXPECT_GE(Localize(30, Walk().size(), &system), 65);
  system.Shutdown();
  EXPECT_GT(system.counts().keyframes, num_keyframes);
  EXPECT_EQ(system.counts().maps, 1);
}

TEST_F(SavedMap, OfFewKeyFramesIsNotGivenUpWithTheFirstFrameThatIsNotFound) {
  MapFrames(5);
  System system(SettingsOfWalk(), options_);
  ASSERT_TRUE(system.LoadMap(path_).ok());
  EXPECT_EQ(system.TrackRgbd(BlackImage(Walk().camera(), kLaterS)).state, TrackingState::kLost);
  EXPECT_EQ(system.counts().maps, 1);
  EXPECT_GE(Localize(0, 5, &system), 3);
}

TEST_F(SavedMap, WhatIsNoMapIsRefusedAndThePresentMapStays) {
  MapFrames(20);
  std::ifstream file(path_, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  const std::string bad_files[] = {
      dir_.Write("truncated", content.substr(0, content.size() / 2)),
      dir_.Write("foreign", "1305031102.175304 0 0 0 0 0 0 1\n"),
      dir_.Write("empty", ""),
      dir_.Path("missing"),
  };
  System system(SettingsOfWalk(), options_);
  TrackFrames(Walk(), 0, 5, &system);
  for (const std::string& path : bad_files) {
    const Status status = system.LoadMap(path);
    ASSERT_FALSE(status.ok()) << path;
    EXPECT_THAT(status.error().message, testing::HasSubstr(path));
  }
  EXPECT_EQ(TrackFrames(Walk(), 5, 10, &system), 5);
  EXPECT_EQ(system.counts().tracked, 10);
}

TEST_F(SavedMap, OfAnotherPyramidIsRefused) {
  MapFrames(10);
  Settings other = SettingsOfWalk();
  other.orb.num_levels = 5;
  System system(other, options_);
  const Status status = system.LoadMap(path_);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, testing::HasSubstr("nLevels"));
}

}  // namespace
}  // namespace orbslam::test
