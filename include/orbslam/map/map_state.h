// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "orbslam/features/scale_pyramid.h"
#include "orbslam/map/keyframe.h"
#include "orbslam/map/map_point.h"

namespace orbslam {

/// What MapData holds, laid open for those who store it: all that cannot be recomputed, and nothing twice.
struct MapState {
  ScalePyramid pyramid;
  uint64_t epoch = 0;
  /// The living, ascending in id, without covisibles, children and loop_edges.
  std::vector<KeyFrame> keyframes;
  /// Of every other id below keyframes.size() + remains.size().
  std::map<KeyFrameId, KeyFrameRemains> remains;
  std::vector<std::pair<KeyFrameId, KeyFrameId>> loop_edges;  // each once, the older keyframe first
  /// The living, ascending in id, without observations: KeyFrame::points tells them.
  std::vector<MapPoint> points;
  uint32_t num_point_ids = 0;  // ever given
  std::map<MapPointId, MapPointId> fused_into;
};

}  // namespace orbslam
