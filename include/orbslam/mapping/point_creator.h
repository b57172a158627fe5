// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/map/map.h"
#include "orbslam/mapping/mapping_options.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Makes points from keypoints that have none yet, in the keyframe and in its best covisibles: by depth if
/// that is the better conditioned, else by triangulation. Returns the new points. Takes guards itself.
/// (ORB-SLAM, Mur-Artal et al. 2015, section VI-C; ORB-SLAM2 2017, section III-A.)
std::vector<MapPointId> CreatePoints(const Sensor& sensor, const MappingOptions& options, KeyFrameId keyframe,
                                     Map* map);

}  // namespace orbslam
