// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/motion_within_frame.h"

#include <algorithm>
#include <cmath>

#include "orbslam/features/corner_depth.h"

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
  if (camera.readout_s == 0) return 0;
  const double row = camera.Distort(undistorted).y();
  return ((row + 0.5) / camera.height - 0.5) * camera.readout_s;
}

/// Metres at the raw pixel that shows x; not positive: none.
double MeasuredM(const MovingView& view, const Sensor& sensor, const Eigen::Vector3d& x) {
  if (!(x.z() > 0)) return -1;
  const Eigen::Vector2d raw = sensor.camera.Distort(sensor.camera.Project(x));
  const cv::Size size = view.depth_m.size();
  if (!(raw.x() > -0.5 && raw.y() > -0.5 && raw.x() < size.width - 0.5 && raw.y() < size.height - 0.5))
    return -1;
  const cv::Point pixel(static_cast<int>(std::lround(raw.x())), static_cast<int>(std::lround(raw.y())));
  return CornerDepthM(view.depth_m, pixel, sensor.depth);
}

/// The depth at which a keypoint's ray meets what the depth image, taken from elsewhere, shows; not positive:
/// none.
double DepthOnRayM(const MovingView& view, const Sensor& sensor, const Rigid3d& later_from_now,
                   const Eigen::Vector2d& pixel, double start_m) {
  constexpr int kSteps = 2;  // the second is for where the first guess was far off
  double depth_m = start_m;
  for (int step = 0; step < kSteps && depth_m > 0; ++step) {
    const Eigen::Vector3d x_later = later_from_now * sensor.camera.Unproject(pixel.x(), pixel.y(), depth_m);
    const double measured_m = MeasuredM(view, sensor, x_later);
    depth_m = measured_m > 0 ? depth_m + measured_m - x_later.z() : -1;
  }
  return depth_m;
}

void SetDepth(const Sensor& sensor, int i, double depth_m, FrameFeatures* features) {
  const bool is_measured = depth_m > 0;
  features->depths_m[i] = is_measured ? static_cast<float>(depth_m) : -1;
  features->right_u[i] =
      is_measured ? static_cast<float>(sensor.depth.RightCoordinate(features->pixels[i].x, depth_m)) : -1;
}

}  // namespace

bool MovingView::IsOfOneInstant(const Sensor& sensor) const {
  return sensor.camera.readout_s == 0 && depth_delay_s == 0;
}

std::shared_ptr<const FrameFeatures> AtOneInstant(const MovingView& view, const Sensor& sensor,
                                                  const MotionModel& motion) {
  if (view.IsOfOneInstant(sensor) || !motion.IsKnown()) return view.features;
  const PinholeCamera& camera = sensor.camera;
  FrameFeatures features = *view.features;
  const double median_depth_m = MedianDepthM(features);
  const Rigid3d later_from_now = motion.Predict(Rigid3d(), view.depth_delay_s);
  for (int i = 0; i < features.size(); ++i) {
    const Eigen::Vector2d seen(features.pixels[i].x, features.pixels[i].y);
    double depth_m = features.depths_m[i];
    const double likely_m = depth_m > 0 ? depth_m : median_depth_m;
    if (view.depth_delay_s != 0) depth_m = DepthOnRayM(view, sensor, later_from_now, seen, likely_m);
    const Rigid3d middle_from_row = motion.Predict(Rigid3d(), -ExposedAfterMiddleS(camera, seen));
    const Eigen::Vector3d x_middle =
        middle_from_row * camera.Unproject(seen.x(), seen.y(), depth_m > 0 ? depth_m : likely_m);
    if (!(x_middle.z() > 0)) continue;  // faster than any hand: leave it as it was seen
    const Eigen::Vector2f pixel = camera.Project(x_middle).cast<float>();
    features.pixels[i] = {pixel.x(), pixel.y()};
    SetDepth(sensor, i, depth_m > 0 ? x_middle.z() : -1, &features);
  }
  features.grid = FeatureGrid(features.pixels, sensor.bounds);
  return std::make_shared<const FrameFeatures>(std::move(features));
}

}  // namespace orbslam
