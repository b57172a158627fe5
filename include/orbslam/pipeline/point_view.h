// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/map/map_point.h"
#include "orbslam/matching/projection_search.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Where, and at which levels, a camera at camera_from_world should see the point: nothing if it is behind, outside
/// the image, outside the point's range of distances, or seen from more than acos(min_view_cos) off its mean viewing
/// direction. The caller sets the radius. (ORB-SLAM, Mur-Artal et al. 2015, section V-D.)
struct PointView {
  ProjectionQuery query;  // radius_px: the scale of the predicted level
  double view_cos = 1;
};
std::optional<PointView> PredictView(const MapPoint& point, const Rigid3d& camera_from_world, const Sensor& sensor,
                                     double min_view_cos = 0.5);

}  // namespace orbslam
