// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/mapping/culling.h"

#include <algorithm>

namespace orbslam {
namespace {

bool IsRedundant(const MapData& map, const Sensor& sensor, const MappingOptions& options,
                 const KeyFrame& keyframe) {
  const FrameFeatures& features = *keyframe.features;
  const double close_limit_m = sensor.depth.CloseLimitM(sensor.camera.fx);
  int num_points = 0, num_redundant = 0;
  for (int i = 0; i < features.size(); ++i) {
    const MapPoint* point = map.Find(keyframe.points[i]);
    if (point == nullptr || !features.HasDepth(i) || features.depths_m[i] > close_limit_m) continue;
    ++num_points;
    if (point->NumObservations() <= options.redundant_observers) continue;
    const auto sees_as_fine = [&](const Observation& other) {
      return other.keyframe != keyframe.id &&
             map.Find(other.keyframe)->features->levels[other.keypoint] <= features.levels[i] + 1;
    };
    num_redundant += std::ranges::count_if(point->observations, sees_as_fine) >= options.redundant_observers;
  }
  return num_redundant > options.redundant_ratio * num_points;
}

bool IsConfirmed(const MapData& map, const MapPoint& point, const MappingOptions& options) {
  const auto measures = [&map](const Observation& observation) {
    return map.Find(observation.keyframe)->features->HasDepth(observation.keypoint);
  };
  return point.NumObservations() >= options.min_unmeasured_observations ||
         std::ranges::any_of(point.observations, measures);
}

}  // namespace

int PointCuller::Cull(KeyFrameId now, MapData* map) {
  int num_erased = 0;
  std::erase_if(young_, [&](const Young& young) {
    const MapPoint* point = map->Find(young.point);
    if (point == nullptr) return true;
    const uint32_t age = now.value - young.born_at.value;
    const bool is_rarely_found = point->times_found < options_.min_found_ratio * point->times_visible;
    const bool is_lonely = age >= 2 && point->NumObservations() < options_.min_young_observations;
    if (is_rarely_found || is_lonely) {
      map->EraseMapPoint(young.point);
      ++num_erased;
      return true;
    }
    return age >= 3;
  });
  return num_erased;
}

int PointCuller::CullUnconfirmed(MapData* map) {
  return static_cast<int>(std::erase_if(young_, [&](const Young& young) {
    const MapPoint* point = map->Find(young.point);
    if (point == nullptr || IsConfirmed(*map, *point, options_)) return false;
    map->EraseMapPoint(young.point);
    return true;
  }));
}

int CullKeyFrames(const Sensor& sensor, const MappingOptions& options, KeyFrameId around, MapData* map) {
  const KeyFrame* center = map->Find(around);
  if (center == nullptr) return 0;
  int num_erased = 0;
  for (const KeyFrameId id : center->BestCovisibles(std::numeric_limits<int>::max())) {
    const KeyFrame* keyframe = map->Find(id);
    if (keyframe != nullptr && IsRedundant(*map, sensor, options, *keyframe))
      num_erased += map->EraseKeyFrame(id);
  }
  return num_erased;
}

}  // namespace orbslam
