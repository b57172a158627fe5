// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/map/map.h"
#include "orbslam/matching/projection_search.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/tracking/moving_region.h"
#include "orbslam/tracking/point_counter.h"
#include "orbslam/tracking/tracking_options.h"

namespace orbslam {

/// Second half of tracking a frame: takes the keyframes round it, looks for their points in it, and refines
/// its pose with all that is found. (ORB-SLAM, Mur-Artal et al. 2015, section V-D.)
class LocalMapTracker {
 public:
  LocalMapTracker(const Map& map, const Sensor& sensor, const TrackingOptions& options)
      : map_(map), sensor_(sensor), options_(options) {}

  struct Result {
    int num_inliers = 0;
    KeyFrameId reference;  // the keyframe that shares most points with the frame; invalid: none does
    // Local points, by the frame's first pose:
    std::vector<MapPointId> on_moving;     // a moving object shows them
    std::vector<MapPointId> near_moving;   // those, what it may have shown a moment ago, or far points deny
    std::vector<MapPointId> seen_through;  // the frame sees what is behind them
  };
  /// frame must have a first pose and first points. Counts what was visible and what was found; what moving
  /// objects hide is neither looked for nor counted.
  Result Track(const MovingRegion& moving, Frame* frame, PointCounter* counter);

 private:
  std::vector<KeyFrameId> LocalKeyFrames(const MapData& map, const Frame& frame) const;
  void CollectCandidates(const MapData& map, const Frame& frame, const std::vector<KeyFrameId>& keyframes,
                         const MovingRegion& moving, Result* result);
  /// What was matched until what is far contradicted it (Frame::moving_below_m) joins near_moving.
  static void CollectContradicted(const MapData& map, const std::vector<MapPointId>& matched,
                                  const Frame& frame, Result* result);
  void MatchCandidates(Frame* frame, PointCounter* counter);

  const Map& map_;
  const Sensor& sensor_;
  const TrackingOptions& options_;
  std::vector<uint32_t> last_visit_;  // index: point id; the visit at which it was last looked at
  uint32_t visit_ = 0;
  std::vector<ProjectionQuery> queries_;
  std::vector<MapPointId> candidates_;  // one a query
};

}  // namespace orbslam
