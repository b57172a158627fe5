// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/synthetic_view.h"

#include <cmath>
#include <numbers>

#include "support/random.h"

namespace orbslam::test {
namespace {

float WrapDegrees(double angle_deg) {
  return static_cast<float>(angle_deg - 360 * std::floor(angle_deg / 360));
}

/// How far the picture of an upright thing is turned in the image of this camera.
double RollDegrees(const Rigid3d& camera_from_world) {
  const Eigen::Matrix3d r = camera_from_world.RotationMatrix();
  return std::atan2(r(1, 0), r(0, 0)) * 180 / std::numbers::pi;
}

}  // namespace

Sensor KinectSensor() {
  PinholeCamera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = 525, camera.fy = 520, camera.cx = 319.5, camera.cy = 239.5;
  return Sensor(camera, DepthModel(), OrbExtractorOptions(), 30);
}

std::vector<Landmark> RandomLandmarks(const Sensor& sensor, int count, Rng* rng) {
  std::vector<Landmark> landmarks;
  for (int i = 0; i < count; ++i) {
    const double u = rng->Uniform(-0.5, 1.5) * sensor.camera.width, v = rng->Uniform(0, sensor.camera.height);
    const Eigen::Vector3d position = sensor.camera.Unproject(u, v, rng->Uniform(1, 5));
    const double max_level = sensor.pyramid.num_levels() - 3;
    landmarks.push_back({position, RandomDescriptor(rng), static_cast<float>(rng->Uniform(0, 360)),
                         position.norm() * std::pow(sensor.pyramid.Scale(1), rng->Uniform(0, max_level))});
  }
  return landmarks;
}

SyntheticView See(const Sensor& sensor, const std::vector<Landmark>& landmarks,
                  const Rigid3d& camera_from_world, Rng* rng, const ViewNoise& noise) {
  FrameFeatures features;
  SyntheticView view;
  const double roll_deg = RollDegrees(camera_from_world);
  for (size_t i = 0; i < landmarks.size(); ++i) {
    const Landmark& landmark = landmarks[i];
    const Eigen::Vector3d x_camera = camera_from_world * landmark.position_world;
    if (x_camera.z() < 0.3) continue;
    const int level = sensor.pyramid.PredictLevel(landmark.max_distance_m, x_camera.norm());
    const Eigen::Vector2d error_px =
        noise.pixel_px * sensor.pyramid.Scale(level) * RandomVector(rng, 1).head<2>();
    const Eigen::Vector2f pixel = (sensor.camera.Project(x_camera) + error_px).cast<float>();
    if (!sensor.bounds.Contains(pixel.x(), pixel.y())) continue;
    features.pixels.emplace_back(pixel.x(), pixel.y());
    features.angles_deg.push_back(WrapDegrees(landmark.angle_deg + roll_deg));
    features.levels.push_back(level);
    features.descriptors.push_back(WithNoise(landmark.descriptor, noise.descriptor_bits, rng));
    features.depths_m.push_back(static_cast<float>(x_camera.z()));
    features.right_u.push_back(static_cast<float>(sensor.depth.RightCoordinate(pixel.x(), x_camera.z())));
    view.landmarks.push_back(static_cast<int>(i));
  }
  features.grid = FeatureGrid(features.pixels, sensor.bounds);
  view.features = std::make_shared<const FrameFeatures>(std::move(features));
  return view;
}

Frame MakeFrame(FrameId id, double timestamp_s, const SyntheticView& view, const Rigid3d& camera_from_world) {
  return {id, timestamp_s, view.features, camera_from_world, std::vector<MapPointId>(view.features->size())};
}

}  // namespace orbslam::test
