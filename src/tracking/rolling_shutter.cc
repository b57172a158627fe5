// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/rolling_shutter.h"

#include <algorithm>

namespace orbslam {
namespace {

/// Metres; anything where no keypoint has depth.
double MedianDepthM(const FrameFeatures& features) {
  constexpr double kUnknownM = 2;
  std::vector<float> depths_m;
  std::ranges::copy_if(features.depths_m, std::back_inserter(depths_m), [](float z) { return z > 0; });
  if (depths_m.empty()) return kUnknownM;
  const auto middle = depths_m.begin() + std::ssize(depths_m) / 2;
  std::ranges::nth_element(depths_m, middle);
  return *middle;
}

/// When the row of a keypoint was exposed, seconds after the middle row.
double ExposedAfterMiddleS(const PinholeCamera& camera, const Eigen::Vector2d& undistorted) {
  const double row = camera.Distort(undistorted).y();
  return ((row + 0.5) / camera.height - 0.5) * camera.readout_s;
}

}  // namespace

std::shared_ptr<const FrameFeatures> UndoRollingShutter(std::shared_ptr<const FrameFeatures> rolled,
                                                        const Sensor& sensor, const MotionModel& motion) {
  const PinholeCamera& camera = sensor.camera;
  if (camera.readout_s == 0 || !motion.IsKnown()) return rolled;
  FrameFeatures features = *rolled;
  const double median_depth_m = MedianDepthM(features);
  for (int i = 0; i < features.size(); ++i) {
    const Eigen::Vector2d seen(features.pixels[i].x, features.pixels[i].y);
    const double depth_m = features.HasDepth(i) ? features.depths_m[i] : median_depth_m;
    const Rigid3d middle_from_row = motion.Predict(Rigid3d(), -ExposedAfterMiddleS(camera, seen));
    const Eigen::Vector3d x_middle = middle_from_row * camera.Unproject(seen.x(), seen.y(), depth_m);
    if (!(x_middle.z() > 0)) continue;  // faster than any hand: leave it as it was seen
    const Eigen::Vector2f pixel = camera.Project(x_middle).cast<float>();
    features.pixels[i] = {pixel.x(), pixel.y()};
    if (!features.HasDepth(i)) continue;
    features.depths_m[i] = static_cast<float>(x_middle.z());
    features.right_u[i] = static_cast<float>(sensor.depth.RightCoordinate(pixel.x(), x_middle.z()));
  }
  features.grid = FeatureGrid(features.pixels, sensor.bounds);
  return std::make_shared<const FrameFeatures>(std::move(features));
}

}  // namespace orbslam
