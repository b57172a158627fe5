// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "map/same_map.h"
#include "orbslam/pipeline/map_bundle.h"
#include "system/synthetic_run.h"
#include "util/temp_dir.h"

namespace orbslam::test {
namespace {

const Recording& Walk() {
  static const Recording recording(Motion::kHalfsphere, 320, 80, /*stride=*/3);
  return recording;
}

class FinalAdjustment : public testing::Test {
 protected:
  FinalAdjustment() {
    TrackFrames(Walk(), 0, Walk().size(), &system_);
    system_.Shutdown();
  }

  MapData CopyOfMap() const { return MapData::FromState(system_.map().Read()->Export()).value(); }

  /// The share of the whole map's reprojection cost that further bundle adjustment would take away.
  double ShareToGain() const {
    const auto guard = system_.map().Read();
    std::set<KeyFrameId> all;
    for (const KeyFrame& keyframe : guard->KeyFrames()) all.insert(keyframe.id);
    MapBundle bundle = GatherBundle(*guard, sensor_, all, 0);
    const BundleSummary summary =
        SolveBundle({.robust_iterations = 50, .final_iterations = 0}, {}, &bundle.problem);
    return 1 - summary.final_cost / summary.initial_cost;
  }

  double CameraAteM() const {
    const std::string path = dir_.Path("camera.txt");
    EXPECT_TRUE(system_.SaveTrajectory(path).ok());
    return AteM(path, Walk());
  }

  const TempDir dir_;
  const Settings settings_ = SettingsFor(Walk().camera(), 600);
  const Sensor sensor_{settings_.camera, settings_.depth, settings_.orb, settings_.fps};
  System system_{settings_, {.mode = {.is_sequential = true}}};
};

TEST_F(FinalAdjustment, LeavesNothingToGain) {
  const double share_before = ShareToGain(), ate_before_m = CameraAteM();
  system_.AdjustMaps();
  EXPECT_LT(ShareToGain(), 0.1 * share_before);
  EXPECT_LT(CameraAteM(), 1.1 * ate_before_m);
  EXPECT_EQ(system_.Timings().at("map.final_bundle").count, 1u);
}

TEST_F(FinalAdjustment, OnceStoppedLeavesTheMapAsItIsUntilTheNextTime) {
  const MapData before = CopyOfMap();
  std::stop_source stop;
  stop.request_stop();
  system_.AdjustMaps(stop.get_token());
  ExpectSame(*system_.map().Read(), before);
  const double share_before = ShareToGain();
  system_.AdjustMaps();
  EXPECT_LT(ShareToGain(), 0.1 * share_before);
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
