// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/frame.h"

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "orbslam/pipeline/messages.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam::test {
namespace {

TEST(Frame, CountsKeypointsWithAPoint) {
  Frame frame;
  EXPECT_EQ(frame.NumPoints(), 0);
  frame.points = {MapPointId(), MapPointId(0), MapPointId(7), MapPointId()};
  EXPECT_EQ(frame.NumPoints(), 2);
}

TEST(Frame, WithItsPointsItForgetsWhatTheySaid) {
  Frame frame;
  frame.points = {MapPointId(4), MapPointId(), MapPointId(2)};
  frame.moving_below_m = 2;
  frame.ForgetPoints();
  EXPECT_EQ(frame.points, std::vector<MapPointId>(3));
  EXPECT_EQ(frame.moving_below_m, 0);
}

TEST(TrackingState, EveryStateHasANameOfItsOwn) {
  const std::set<std::string> names = {Name(TrackingState::kNotInitialized), Name(TrackingState::kOk),
                                       Name(TrackingState::kLost)};
  EXPECT_THAT(names, testing::SizeIs(3));
  EXPECT_THAT(names, testing::Not(testing::Contains("?")));
}

TEST(Sensor, AgreesWithItsParts) {
  const PinholeCamera camera{640, 480, 525, 520, 319.5, 239.5, {0.1, 0, 0, 0, 0}};
  const DepthModel depth{.baseline_times_fx = 35};
  const OrbExtractorOptions orb{.scale_factor = 1.5, .num_levels = 4};
  const Sensor sensor(camera, depth, orb, 30);
  EXPECT_EQ(sensor.intrinsics.fx, camera.fx);
  EXPECT_EQ(sensor.intrinsics.bf, depth.baseline_times_fx);
  EXPECT_EQ(sensor.pyramid.num_levels(), orb.num_levels);
  EXPECT_DOUBLE_EQ(sensor.pyramid.Scale(2), 2.25);
  EXPECT_EQ(sensor.bounds.max_u, UndistortedBounds(camera).max_u);
}

}  // namespace
}  // namespace orbslam::test
