// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <vector>

#include "orbslam/map/map_data.h"
#include "orbslam/optimization/bundle_adjuster.h"
#include "orbslam/pipeline/past_frame.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// A part of the map as a bundle adjustment problem, and who is who in it.
struct MapBundle {
  BundleProblem problem;
  std::vector<KeyFrameId> keyframes;  // one a pose; poses behind them are frames that are none
  std::vector<MapPointId> points;     // one a point, ascending
  uint64_t epoch = 0;                 // of the map when it was gathered
};

/// Copies the `moving` keyframes, all points they see, and every other keyframe that sees those points: as
/// fixed ones, at most max_fixed, those with most observations first. The map's root is always fixed.
MapBundle GatherBundle(const MapData& map, const Sensor& sensor, const std::set<KeyFrameId>& moving,
                       int max_fixed);

/// Adds a frame that is no keyframe, with its sightings of points that are in the bundle. Its pose may move.
/// Nothing happens if its reference is not in the map.
void AddFrame(const MapData& map, const Sensor& sensor, const PastFrame& frame, MapBundle* bundle);

/// Writes refined poses and points back and removes observations that are no inliers. Ids that are gone by
/// now are passed over. Nothing happens if the map was corrected globally since the gathering: false.
bool ApplyBundle(const MapBundle& bundle, const BundleSummary& summary, MapData* map);

}  // namespace orbslam
