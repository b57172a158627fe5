// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/point_fusion.h"

#include <algorithm>

#include "orbslam/pipeline/point_view.h"

namespace orbslam {
namespace {

struct FusionCandidates {
  std::shared_ptr<const FrameFeatures> features;
  PointQueries wanted;
};

FusionCandidates Gather(const MapData& map, const Sensor& sensor, KeyFrameId keyframe_id,
                        std::span<const MapPointId> points, double radius_px) {
  FusionCandidates candidates;
  const KeyFrame* keyframe = map.Find(keyframe_id);
  if (keyframe == nullptr) return candidates;
  candidates.features = keyframe->features;
  for (const MapPointId id : points) {
    const MapPoint* point = map.Find(id);
    if (point == nullptr) continue;
    const auto seen = std::ranges::lower_bound(point->observations, keyframe_id, {}, &Observation::keyframe);
    if (seen != point->observations.end() && seen->keyframe == keyframe_id) continue;
    candidates.wanted.Add(*point, keyframe->camera_from_world, sensor, radius_px);
  }
  return candidates;
}

/// Both points are alive and different; the more often seen survives.
void FuseInto(MapPointId a, MapPointId b, MapData* map) {
  const bool keep_a = map->Find(a)->NumObservations() > map->Find(b)->NumObservations();
  map->FuseMapPoint(keep_a ? b : a, keep_a ? a : b);
}

}  // namespace

int FusePoints(const Sensor& sensor, KeyFrameId keyframe_id, std::span<const MapPointId> points,
               double radius_px, Map* map) {
  const auto [features, wanted] = Gather(*map->Read(), sensor, keyframe_id, points, radius_px);
  if (wanted.queries.empty()) return 0;
  const std::vector<int> match =
      SearchByProjection(wanted.queries, *features, {}, {.max_distance = kStrictMaxDistance});
  int num_fused = 0;
  const auto guard = map->Write();
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] < 0) continue;
    const KeyFrame* keyframe = guard->Find(keyframe_id);
    const MapPointId id = guard->Resolve(wanted.points[q]);
    if (keyframe == nullptr || !id.IsValid()) continue;
    const Eigen::Vector3d x_camera = keyframe->camera_from_world * guard->Find(id)->position_world;
    if (!IsWithinGate(sensor, x_camera, *features, match[q])) continue;
    const MapPointId present = keyframe->points[match[q]];
    if (present == id) continue;
    if (present.IsValid()) {
      FuseInto(present, id, &*guard);
      ++num_fused;
    } else if (guard->AddObservation(id, keyframe_id, match[q])) {
      guard->RefreshMapPoint(id);
      ++num_fused;
    }
  }
  return num_fused;
}

}  // namespace orbslam
