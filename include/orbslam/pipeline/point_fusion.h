// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "orbslam/map/map.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Looks for the points in a keyframe that does not list them yet. Where a keypoint without a point is found,
/// it gets the point; where it has another point, the two are fused into the one with more observations.
/// Returns how many points gained an observation or were fused. Takes guards itself: none may be held.
int FusePoints(const Sensor& sensor, KeyFrameId keyframe, std::span<const MapPointId> points,
               double radius_px, Map* map);

}  // namespace orbslam
