// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/keyframe_creator.h"

#include <algorithm>

namespace orbslam {
namespace {

/// Keypoints that become depth points, or already are points: closest first.
std::vector<int> KeypointsWithinReach(const FrameFeatures& features, double close_limit_m, int min_count) {
  std::vector<int> with_depth;
  for (int i = 0; i < features.size(); ++i) {
    if (features.HasDepth(i)) with_depth.push_back(i);
  }
  std::ranges::stable_sort(with_depth, {}, [&](int i) { return features.depths_m[i]; });
  const auto end =
      std::ranges::find_if(with_depth, [&](int i) { return features.depths_m[i] > close_limit_m; });
  const auto num_close = static_cast<int>(end - with_depth.begin());
  with_depth.resize(std::min<size_t>(with_depth.size(), std::max(num_close, min_count)));
  return with_depth;
}

void AddObservations(KeyFrameId keyframe, Frame* frame, MapData* map) {
  for (int i = 0; i < frame->features->size(); ++i) {
    MapPointId& id = frame->points[i];
    if (!id.IsValid()) continue;
    id = map->Resolve(id);
    if (!id.IsValid() || !map->AddObservation(id, keyframe, i)) {
      id = MapPointId();
      continue;
    }
    map->RefreshMapPoint(id);
  }
}

void AddDepthPoints(const Sensor& sensor, int min_count, KeyFrameId keyframe, Frame* frame, MapData* map) {
  const FrameFeatures& features = *frame->features;
  const Rigid3d world_from_camera = Inverse(frame->camera_from_world);
  const double close_limit_m = sensor.depth.CloseLimitM(sensor.camera.fx);
  for (const int i : KeypointsWithinReach(features, close_limit_m, min_count)) {
    if (frame->points[i].IsValid() || features.depths_m[i] < frame->moving_below_m) continue;
    const cv::Point2f& pixel = features.pixels[i];
    const Eigen::Vector3d x_camera = sensor.camera.Unproject(pixel.x, pixel.y, features.depths_m[i]);
    const MapPointId id = map->AddMapPoint(world_from_camera * x_camera, keyframe);
    map->AddObservation(id, keyframe, i);
    map->RefreshMapPoint(id);
    frame->points[i] = id;
  }
}

}  // namespace

std::optional<KeyFrameId> CreateKeyFrame(const Sensor& sensor, int min_depth_points,
                                         KeyFrameId parent_fallback, uint64_t epoch, Frame* frame, Map* map) {
  const auto guard = map->Write();
  if (guard->epoch() != epoch) return std::nullopt;
  const KeyFrameId id =
      guard->AddKeyFrame(frame->id, frame->timestamp_s, frame->camera_from_world, frame->features);
  AddObservations(id, frame, &*guard);
  if (guard->num_keyframes() > 1) guard->ConnectToSpanningTree(id, guard->Resolve(parent_fallback));
  AddDepthPoints(sensor, min_depth_points, id, frame, &*guard);
  return id;
}

}  // namespace orbslam
