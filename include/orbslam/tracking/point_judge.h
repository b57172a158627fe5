// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "orbslam/map/map.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/tracking/local_map_tracker.h"
#include "orbslam/tracking/quarantine.h"

namespace orbslam {

/// Erases map points that were made on something before anyone knew that it moves: those that moving objects
/// show, and those left in mid-air by who has walked off.
class PointJudge {
 public:
  PointJudge(const Sensor& sensor, Map* map) : sensor_(sensor), map_(map) {}

  /// found: by frame, whose pose is known. last: the last one that was tracked before; nullptr: there was
  /// none.
  void Judge(const LocalMapTracker::Result& found, const Frame& frame, const Frame* last);
  /// What keyframes after since_s saw of these points no longer counts: it is taken out of the map.
  void Retract(const std::vector<MapPointId>& points, double since_s);
  /// Takes the points out of the map that enough frames have spoken against.
  void EraseCondemned();
  /// Of the points that the keyframe saw: how many it has lost to both.
  int NumTakenFrom(KeyFrameId keyframe) const;

 private:
  void RefuteSeenThrough(const std::vector<MapPointId>& seen_through, const Frame& frame, const Frame& last);

  const Sensor& sensor_;
  Map* map_;
  Quarantine quarantine_;
  std::map<KeyFrameId, int> num_taken_;
};

}  // namespace orbslam
