// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/point_fusion.h"

#include <algorithm>

#include "orbslam/pipeline/point_view.h"

namespace orbslam {
namespace {

// Chi-square at 95 %: 2 and 3 degrees of freedom.
constexpr double kMaxChi2Mono = 5.991, kMaxChi2Stereo = 7.815;

struct FusionCandidates {
  std::shared_ptr<const FrameFeatures> features;
  std::vector<ProjectionQuery> queries;
  std::vector<MapPointId> points;  // one a query
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
    auto view = PredictView(*point, keyframe->camera_from_world, sensor);
    if (!view) continue;
    view->query.radius_px *= static_cast<float>(radius_px);
    candidates.queries.push_back(view->query);
    candidates.points.push_back(id);
  }
  return candidates;
}

bool Agrees(const ProjectionQuery& query, const FrameFeatures& features, int keypoint, const Sensor& sensor) {
  const cv::Point2f& pixel = features.pixels[keypoint];
  const double du = pixel.x - query.u, dv = pixel.y - query.v;
  double error2 = du * du + dv * dv;
  double limit = kMaxChi2Mono;
  if (features.right_u[keypoint] >= 0) {
    const double dr = features.right_u[keypoint] - query.right_u;
    error2 += dr * dr;
    limit = kMaxChi2Stereo;
  }
  return error2 * sensor.pyramid.InverseVariance(features.levels[keypoint]) <= limit;
}

/// Both points are alive and different; the more often seen survives.
void FuseInto(MapPointId a, MapPointId b, MapData* map) {
  const bool keep_a = map->Find(a)->NumObservations() > map->Find(b)->NumObservations();
  map->FuseMapPoint(keep_a ? b : a, keep_a ? a : b);
}

}  // namespace

int FusePoints(const Sensor& sensor, KeyFrameId keyframe_id, std::span<const MapPointId> points, double radius_px,
               Map* map) {
  const FusionCandidates candidates = Gather(*map->Read(), sensor, keyframe_id, points, radius_px);
  if (candidates.queries.empty()) return 0;
  const std::vector<int> match =
      SearchByProjection(candidates.queries, *candidates.features, {}, {.max_distance = kStrictMaxDistance});
  int num_fused = 0;
  const auto guard = map->Write();
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] < 0 || !Agrees(candidates.queries[q], *candidates.features, match[q], sensor)) continue;
    const KeyFrame* keyframe = guard->Find(keyframe_id);
    const MapPointId id = guard->Resolve(candidates.points[q]);
    if (keyframe == nullptr || !id.IsValid()) continue;
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
