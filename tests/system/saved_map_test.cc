// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
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
    ASSERT_EQ(TrackFrames(Walk(), 0, num_frames, &mapper), num_frames);
    ASSERT_TRUE(mapper.SaveMap(path_).ok());
    ASSERT_TRUE(mapper.SaveTrajectory(dir_.Path("mapped.txt")).ok());
    mapped_ = ReadTrajectory(dir_.Path("mapped.txt")).value();
  }
  /// Tracks frames first .. last-1 in the saved map. For those with a pose that were shown while mapping: how
  /// far the two poses are apart, ascending; for others that have a pose, 0.
  std::vector<double> Localize(int first, int last, System* system) {
    std::vector<double> distances_m;
    for (int i = first; i < last; ++i) {
      const auto report = system->TrackRgbd(Walk().ImageAt(i, kLaterS + Walk()[i].timestamp_s));
      if (!report.world_from_camera) continue;
      const Rigid3d expected =
          i < std::ssize(mapped_) ? mapped_[i].world_from_camera : *report.world_from_camera;
      distances_m.push_back((report.world_from_camera->translation - expected.translation).norm());
    }
    std::ranges::sort(distances_m);
    return distances_m;
  }

  const TempDir dir_;
  const std::string path_ = dir_.Path("room.map");
  std::vector<StampedPose> mapped_;
  const SystemOptions options_{.vocabulary = ShippedVocabulary()};
};

TEST_F(SavedMap, IsLocalizedInFromTheFirstFrames) {
  MapFrames(Walk().size());
  System system(SettingsOfWalk(), options_);
  system.ActivateLocalizationMode();
  ASSERT_TRUE(system.LoadMap(path_).ok());
  const MapData before = MapData::FromState(system.map().Read()->Export()).value();
  constexpr int kFirst = 40, kMaxFramesToFind = 3;
  const std::vector<double> distances_m = Localize(kFirst, 95, &system);
  ASSERT_GE(std::ssize(distances_m), 95 - kFirst - kMaxFramesToFind);
  EXPECT_LT(distances_m[distances_m.size() * 9 / 10], 0.05);
  system.Shutdown();
  system.AdjustMaps();
  ExpectSame(*system.map().Read(), before);
}

TEST_F(SavedMap, IsExtendedWhenMappingGoesOn) {
  MapFrames(50);
  System system(SettingsOfWalk(), options_);
  ASSERT_TRUE(system.LoadMap(path_).ok());
  const int num_keyframes = system.counts().keyframes;
  EXPECT_GE(Localize(30, Walk().size(), &system).size(), 65u);
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
  EXPECT_GE(Localize(0, 5, &system).size(), 3u);
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
