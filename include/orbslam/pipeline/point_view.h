// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/map/map_point.h"
#include "orbslam/matching/projection_search.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Where, and at which levels, a camera at camera_from_world should see the point: nothing if it is behind,
/// outside the image, outside the point's range of distances, or seen from more than acos(min_view_cos) off
/// its mean viewing direction. The caller sets the radius. (ORB-SLAM, Mur-Artal et al. 2015, section V-D.)
struct PointView {
  ProjectionQuery query;  // radius_px: the scale of the predicted level
  double view_cos = 1;
};
std::optional<PointView> PredictView(const MapPoint& point, const Rigid3d& camera_from_world,
                                     const Sensor& sensor, double min_view_cos = 0.5);

/// Whether keypoint i can show a point at x_camera: reprojection error within the chi-square gate at 95 %, of
/// 2 degrees of freedom, or of 3 where it has depth.
bool IsWithinGate(const Sensor& sensor, const Eigen::Vector3d& x_camera, const FrameFeatures& features,
                  int i);

/// Points to look for in a frame: queries for SearchByProjection, and whose they are.
struct PointQueries {
  std::vector<ProjectionQuery> queries;
  std::vector<MapPointId> points;  // one a query

  /// Adds the point if the camera should see it. radius_px: px of the level at which it should be seen.
  void Add(const MapPoint& point, const Rigid3d& camera_from_world, const Sensor& sensor, double radius_px);
};

}  // namespace orbslam
