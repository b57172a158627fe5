// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/point_view.h"

namespace orbslam {

std::optional<PointView> PredictView(const MapPoint& point, const Rigid3d& camera_from_world,
                                     const Sensor& sensor, double min_view_cos) {
  const Eigen::Vector3d x_camera = camera_from_world * point.position_world;
  if (x_camera.z() <= 0) return std::nullopt;
  const Eigen::Vector3f pixel = sensor.intrinsics.Project(x_camera).cast<float>();
  if (!sensor.bounds.Contains(pixel.x(), pixel.y())) return std::nullopt;
  const double distance_m = x_camera.norm();
  // A level more than the range at both ends: the pyramid's steps are coarse.
  if (distance_m < 0.8 * point.min_distance_m || distance_m > 1.2 * point.max_distance_m) return std::nullopt;
  const double view_cos = x_camera.dot(camera_from_world.rotation * point.normal_world) / distance_m;
  if (view_cos < min_view_cos) return std::nullopt;
  const int level = sensor.pyramid.PredictLevel(point.max_distance_m, distance_m);
  return PointView{.query = {.descriptor = point.descriptor,
                             .u = pixel.x(),
                             .v = pixel.y(),
                             .right_u = pixel.z(),
                             .radius_px = static_cast<float>(sensor.pyramid.Scale(level)),
                             .min_level = level - 1,
                             .max_level = level},
                   .view_cos = view_cos};
}

bool IsWithinGate(const Sensor& sensor, const Eigen::Vector3d& x_camera, const FrameFeatures& features,
                  int i) {
  const cv::Point2f& pixel = features.pixels[i];
  const Eigen::Vector3d measured(pixel.x, pixel.y, features.right_u[i]);
  if (x_camera.z() < NearestUsableM(measured)) return false;
  const Eigen::Vector3d error = sensor.intrinsics.ReprojectionError(x_camera, measured);
  const double max_chi2 = features.right_u[i] < 0 ? 5.991 : 7.815;
  return error.squaredNorm() * sensor.pyramid.InverseVariance(features.levels[i]) <= max_chi2;
}

void PointQueries::Add(const MapPoint& point, const Rigid3d& camera_from_world, const Sensor& sensor,
                       double radius_px) {
  auto view = PredictView(point, camera_from_world, sensor);
  if (!view) return;
  view->query.radius_px *= static_cast<float>(radius_px);
  queries.push_back(view->query);
  points.push_back(point.id);
}

}  // namespace orbslam
