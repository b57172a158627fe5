// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/trajectory_log.h"

#include <functional>

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

class TrajectoryLogTest : public SyntheticMap {
 protected:
  TrajectoryLogTest() {
    Frame frame = SeeAndKnow(reference_from_world_);
    reference_ = AddKeyFrame(&frame);
    for (uint32_t i = 0; i < 3; ++i) {
      FrameReport report{.id = FrameId(i), .timestamp_s = 0.1 * i, .reference = reference_};
      report.world_from_camera = Rigid3d();  // it was tracked
      report.camera_from_reference = PoseOf(i);
      log_.Add({.id = FrameId(i), .timestamp_s = 0.1 * i}, report);
    }
  }
  static Rigid3d PoseOf(double i) { return {So3Exp({0, 0.1 * i, 0}), {0.2 * i, 0, 0}}; }
  void ExpectPose(int index, const Rigid3d& camera_from_reference) {
    EXPECT_THAT(log_.Camera(map_)[index].world_from_camera,
                Rigid3dNear(Inverse(camera_from_reference * reference_from_world_), 1e-9, 1e-9));
  }

  const Rigid3d reference_from_world_{So3Exp({0, 0, 0.3}), {0, 0.1, 0}};
  KeyFrameId reference_;
  TrajectoryLog log_{MotionPrior{.acceleration_mps2 = 0}};
};

TEST_F(TrajectoryLogTest, PosesAreThoseRelativeToTheKeyFrame) {
  ASSERT_EQ(log_.Camera(map_).size(), 3u);
  for (int i = 0; i < 3; ++i) ExpectPose(i, PoseOf(i));
}

TEST_F(TrajectoryLogTest, ARevisedPoseReplacesTheFirst) {
  log_.Revise({FrameId(1), 0.1, reference_, PoseOf(7), Matrix6d::Identity(), {}});
  ASSERT_EQ(log_.Camera(map_).size(), 3u);
  ExpectPose(0, PoseOf(0));
  ExpectPose(1, PoseOf(7));
  ExpectPose(2, PoseOf(2));
}

TEST_F(TrajectoryLogTest, PosesAreFoundAgainWhereSightingsAreKnown) {
  const Rigid3d truth = PoseOf(0.3) * reference_from_world_;
  const Frame seen = SeeAndKnow(truth);
  log_.Revise({FrameId(1), 0.1, reference_, PoseOf(0.4), Matrix6d::Identity(), SightingsOf(seen)});
  log_.FindPosesAgain(map_, sensor_, {});
  ExpectPose(0, PoseOf(0));
  EXPECT_THAT(log_.Camera(map_)[1].world_from_camera, Rigid3dNear(Inverse(truth), kMaxErrorM, kMaxErrorRad));
  ExpectPose(2, PoseOf(2));
}

TEST_F(TrajectoryLogTest, AStopLeavesPosesAsTheyAre) {
  const Frame seen = SeeAndKnow(PoseOf(0.3) * reference_from_world_);
  log_.Revise({FrameId(1), 0.1, reference_, PoseOf(0.4), Matrix6d::Identity(), SightingsOf(seen)});
  std::stop_source stop;
  stop.request_stop();
  log_.FindPosesAgain(map_, sensor_, stop.get_token());
  ExpectPose(1, PoseOf(0.4));
}

/// A log of frames at 30 Hz; what those saw of which it is asked is known, and something moved in others.
TrajectoryLog LogOfSightings(
    uint32_t num_frames, const std::function<bool(uint32_t)>& has_sightings,
    const std::function<bool(uint32_t)>& is_masked = [](uint32_t) { return false; }) {
  TrajectoryLog log{MotionPrior{}};
  for (uint32_t i = 0; i < num_frames; ++i) {
    FrameReport report{.id = FrameId(i), .timestamp_s = i / 30.0, .world_from_camera = Rigid3d()};
    report.masked_share = is_masked(i) ? 0.3 : 0;
    log.Add({.id = FrameId(i), .timestamp_s = report.timestamp_s}, report);
    if (has_sightings(i)) log.Revise({FrameId(i), report.timestamp_s, {}, {}, {}, std::vector<Sighting>(1)});
  }
  return log;
}

TEST(TrajectoryLogSample, OfHoursIsOfTheirEnd) {
  const TrajectoryLog log = LogOfSightings(20010, [](uint32_t) { return true; });
  const auto all = log.Sample({0, 0}, 100000);
  EXPECT_EQ(all.size(), 20000u) << "memory is bounded";
  EXPECT_EQ(all.front()->id, FrameId(10));
}

TEST(TrajectoryLogSample, IsSpreadInTimeOverFramesThatSawAnything) {
  const TrajectoryLog log = LogOfSightings(300, [](uint32_t i) { return i < 100 || i >= 200; });
  const auto all = log.Sample({.clear_s = 0.2, .masked_s = 0.1}, /*max_count=*/1000);
  EXPECT_EQ(all.size(), 34u) << "every sixth of two hundred";
  for (const PastFrame* frame : all) EXPECT_FALSE(frame->sightings.empty());
  for (size_t i = 1; i < all.size(); ++i) EXPECT_GT(all[i]->timestamp_s - all[i - 1]->timestamp_s, 0.199);
  const auto few = log.Sample({0.2, 0.1}, 8);
  ASSERT_EQ(few.size(), 8u);
  EXPECT_EQ(few.front(), all.front());
  for (size_t i = 1; i < few.size(); ++i) EXPECT_GT(few[i]->timestamp_s, few[i - 1]->timestamp_s);
  EXPECT_GT(few.back()->timestamp_s, 8.0);
}

TEST(TrajectoryLogSample, IsDenserWhereSomethingMoves) {
  const TrajectoryLog log = LogOfSightings(
      300, [](uint32_t) { return true; }, [](uint32_t i) { return i >= 150; });
  const auto all = log.Sample({.clear_s = 0.2, .masked_s = 0.1}, 1000);
  const auto num_early = std::ranges::count_if(all, [](const PastFrame* f) { return f->id < FrameId(150); });
  EXPECT_EQ(num_early, 25) << "every sixth";
  EXPECT_EQ(std::ssize(all) - num_early, 50) << "every third";
}

/// One frame a tenth of a second, of which the third jumps by a hand's breadth.
class SmoothedLogTest : public TrajectoryLogTest {
 protected:
  void Add(uint32_t i, double place, double information) {
    FrameReport report{.id = FrameId(i), .timestamp_s = 0.1 * i, .reference = reference_};
    report.world_from_camera = Rigid3d();
    report.camera_from_reference = PoseOf(place);
    report.pose_information = information * Matrix6d::Identity();
    smoothed_.Add({.id = FrameId(i), .timestamp_s = 0.1 * i}, report);
  }
  double DistanceM(int index, double place) const {
    const Rigid3d expected = Inverse(PoseOf(place) * reference_from_world_);
    return (smoothed_.Camera(map_)[index].world_from_camera.translation - expected.translation).norm();
  }
  TrajectoryLog smoothed_{MotionPrior{}};
};

TEST_F(SmoothedLogTest, PosesAreSmoothAsFarAsTheyAreNotKnown) {
  constexpr double kStep = 0.3;  // 0.6 m/s, 0.3 rad/s: as a hand turns
  for (uint32_t i = 0; i < 7; ++i) Add(i, kStep * i + (i == 3 ? 0.4 : 0), i == 3 ? 1 : 1e8);
  EXPECT_LT(DistanceM(3, 3 * kStep), 0.005);
  EXPECT_LT(DistanceM(2, 2 * kStep), 0.005);
  const double jumped = 3 * kStep + 0.4;
  smoothed_.Revise({FrameId(3), 0.3, reference_, PoseOf(jumped), 1e10 * Matrix6d::Identity(), {}});
  EXPECT_LT(DistanceM(3, jumped), 0.01);
}

TEST_F(SmoothedLogTest, AKeyFramesPoseIsTheTrajectorys) {
  for (uint32_t i = 0; i < 7; ++i) Add(i, i == 3 ? 3.4 : i, 1e4);
  Frame frame = SeeAndKnow(reference_from_world_);
  while (frame.id != FrameId(3)) frame = SeeAndKnow(reference_from_world_);
  AddKeyFrame(&frame);  // besides that of frame 0
  const std::vector<StampedPose> keyframes = smoothed_.KeyFrames(map_), camera = smoothed_.Camera(map_);
  ASSERT_EQ(keyframes.size(), 2u);
  EXPECT_EQ(keyframes[1].timestamp_text, camera[3].timestamp_text);
  EXPECT_EQ(keyframes[1].world_from_camera.translation, camera[3].world_from_camera.translation);
  EXPECT_GT(DistanceM(3, 3.4), 0.005);
}

TEST_F(SmoothedLogTest, WhereTheCameraIsFoundAgainIsNotDrawnToWhereItWasLost) {
  for (uint32_t i = 0; i < 4; ++i) Add(i, 0, 1e4);
  smoothed_.Add({.id = FrameId(4), .timestamp_s = 0.4}, {.id = FrameId(4), .timestamp_s = 0.4});
  for (uint32_t i = 5; i < 9; ++i) Add(i, 3, 1e4);
  for (int index = 0; index < 8; ++index) EXPECT_LT(DistanceM(index, index < 4 ? 0 : 3), 1e-3);
}

}  // namespace
}  // namespace orbslam::test
