// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>

#include "orbslam/map/map_data.h"

namespace orbslam {

/// A better estimate of some keyframes, and perhaps of points.
struct MapCorrection {
  std::map<KeyFrameId, Rigid3d> camera_from_world;
  std::map<MapPointId, Eigen::Vector3d> position_world;
};

/// Corrects the whole map and counts an epoch. Keyframes without an estimate of their own (made since the
/// estimate was begun) keep their pose relative to their parent in the spanning tree; points without one move
/// with the keyframe that saw them first.
void CorrectMap(const MapCorrection& correction, MapData* map);

}  // namespace orbslam
