// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/map/map_data.h"
#include "orbslam/mapping/mapping_options.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Watches young points: those that are rarely found where they should be, or that no further keyframe comes
/// to see, are erased; the others are trusted after three keyframes. (ORB-SLAM, Mur-Artal et al. 2015,
/// section VI-B.)
class PointCuller {
 public:
  explicit PointCuller(const MappingOptions& options) : options_(options) {}

  void Watch(MapPointId point, KeyFrameId born_at) { young_.push_back({point, born_at}); }
  /// Returns the number of points erased. now: the newest keyframe.
  int Cull(KeyFrameId now, MapData* map);
  /// Erases the young points whose depth no keyframe has measured, unless min_unmeasured_observations agree
  /// on it: two keyframes find a place for any mismatch along the epipolar line, and one that is very near
  /// turns the pose of hundreds of true points. Returns how many.
  int CullUnconfirmed(MapData* map);
  void Clear() { young_.clear(); }

 private:
  struct Young {
    MapPointId point;
    KeyFrameId born_at;
  };
  const MappingOptions& options_;
  std::vector<Young> young_;
};

/// The covisibles of a keyframe whose close points are nearly all seen by enough others at the same or a
/// finer scale: erased. Returns how many. (ORB-SLAM, section VI-E.)
int CullKeyFrames(const Sensor& sensor, const MappingOptions& options, KeyFrameId around, MapData* map);

}  // namespace orbslam
