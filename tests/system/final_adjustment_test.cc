// SPDX-License-Identifier: GPL-3.0-or-later
#include "map/same_map.h"
#include "system/synthetic_run.h"
#include "util/temp_dir.h"

namespace orbslam::test {
namespace {

/// Nearly a round of the room: local adjustments leave centimetres of drift.
const Recording& Walk() {
  static const Recording recording(Motion::kLoop, 320, 200, /*stride=*/3);
  return recording;
}

class FinalAdjustment : public testing::Test {
 protected:
  FinalAdjustment() {
    TrackFrames(Walk(), 0, Walk().size(), &system_);
    system_.Shutdown();
  }

  MapData CopyOfMap() const { return MapData::FromState(system_.map().Read()->Export()).value(); }

  double CameraAteM() const {
    const std::string path = dir_.Path("camera.txt");
    EXPECT_TRUE(system_.SaveTrajectory(path).ok());
    return AteM(path, Walk());
  }

  const TempDir dir_;
  const Settings settings_ = SettingsFor(Walk().camera(), 600);
  System system_{settings_, {.mode = {.is_sequential = true}}};
};

TEST_F(FinalAdjustment, BringsTheTrajectoryNearerToTheTruth) {
  const double ate_before_m = CameraAteM();
  system_.AdjustMaps();
  EXPECT_LT(CameraAteM(), 0.9 * ate_before_m) << ate_before_m;
  EXPECT_EQ(system_.Timings().at("map.final_bundle").count, 1u);
}

TEST_F(FinalAdjustment, OnceStoppedLeavesAllAsItIsUntilTheNextTime) {
  const MapData before = CopyOfMap();
  const double ate_before_m = CameraAteM();
  std::stop_source stop;
  stop.request_stop();
  system_.AdjustMaps(stop.get_token());
  ExpectSame(*system_.map().Read(), before);
  EXPECT_EQ(CameraAteM(), ate_before_m);
  system_.AdjustMaps();
  EXPECT_LT(CameraAteM(), 0.9 * ate_before_m);
}

TEST_F(FinalAdjustment, OfAMapThatHasNotGrownSinceChangesNothing) {
  system_.AdjustMaps();
  const MapData before = CopyOfMap();
  system_.AdjustMaps();
  ExpectSame(*system_.map().Read(), before);
}

TEST(FinalAdjustmentOfNothing, IsNoError) {
  System system(SettingsFor(Walk().camera(), 600));
  system.Shutdown();
  system.AdjustMaps();
  EXPECT_EQ(system.counts().keyframes, 0);
}

}  // namespace
}  // namespace orbslam::test
