// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/util/random.h"

namespace orbslam::test {

/// A Kinect of 640 x 480 without distortion at 30 Hz; close points are nearer than 3.05 m.
Sensor KinectSensor();

/// A landmark that looks the same from everywhere.
struct Landmark {
  Eigen::Vector3d position_world;
  Descriptor descriptor;
  float angle_deg;        // of its keypoint in a camera that does not roll
  double max_distance_m;  // at which it appears on level 0
};

/// Random landmarks 1 to 5 m away from a camera at the world's origin: half of them in its view, a quarter
/// each to the left and to the right of it.
std::vector<Landmark> RandomLandmarks(const Sensor& sensor, int count, Rng* rng);

struct ViewNoise {
  double pixel_px = 0;      // standard deviation on level 0; grows with the level's scale
  int descriptor_bits = 0;  // flipped at most
};

/// What a camera sees of landmarks, without any image.
struct SyntheticView {
  std::shared_ptr<const FrameFeatures> features;
  std::vector<int> landmarks;  // one a keypoint
};
SyntheticView See(const Sensor& sensor, const std::vector<Landmark>& landmarks,
                  const Rigid3d& camera_from_world, Rng* rng, const ViewNoise& noise = {});

/// A frame with these features, as yet without points.
Frame MakeFrame(FrameId id, double timestamp_s, const SyntheticView& view, const Rigid3d& camera_from_world);

}  // namespace orbslam::test
