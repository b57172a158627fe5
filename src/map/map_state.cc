// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/map/map_state.h"

#include <algorithm>
#include <utility>

#include "map_state_check.h"
#include "orbslam/map/map_data.h"

namespace orbslam {

MapState MapData::Export() const {
  MapState state{.pyramid = pyramid_, .epoch = epoch_, .remains = remains_, .fused_into = fused_into_};
  state.keyframes.reserve(num_keyframes_);
  for (const KeyFrame& keyframe : KeyFrames()) {
    for (const KeyFrameId newer : keyframe.loop_edges) {
      if (keyframe.id < newer) state.loop_edges.emplace_back(keyframe.id, newer);
    }
    state.keyframes.push_back({.id = keyframe.id,
                               .frame_id = keyframe.frame_id,
                               .timestamp_s = keyframe.timestamp_s,
                               .camera_from_world = keyframe.camera_from_world,
                               .features = keyframe.features,
                               .points = keyframe.points,
                               .parent = keyframe.parent});
  }
  state.points.reserve(num_points_);
  for (const MapPoint& point : MapPoints()) {
    state.points.push_back(point);
    state.points.back().observations.clear();
  }
  state.num_point_ids = static_cast<uint32_t>(points_.size());
  return state;
}

Result<MapData> MapData::FromState(MapState state) {
  if (const Status status = CheckMapState(state); !status) return status.error();
  MapData map(state.pyramid);
  map.epoch_ = state.epoch;
  map.num_keyframes_ = static_cast<int>(state.keyframes.size());
  map.num_points_ = static_cast<int>(state.points.size());
  map.keyframes_.resize(state.keyframes.size() + state.remains.size());
  map.points_.resize(state.num_point_ids);
  map.remains_ = std::move(state.remains);
  map.fused_into_ = std::move(state.fused_into);
  for (MapPoint& point : state.points) {
    point.observations.clear();
    map.points_[point.id.value] = std::make_unique<MapPoint>(std::move(point));
  }
  for (KeyFrame& keyframe : state.keyframes) {
    keyframe.covisibles.clear();
    keyframe.children.clear();
    keyframe.loop_edges.clear();
    map.keyframes_[keyframe.id.value] = std::make_unique<KeyFrame>(std::move(keyframe));
  }
  for (const auto& [older, newer] : state.loop_edges) map.AddLoopEdge(older, newer);
  map.RelinkKeyFrames();
  map.RecountCovisibility();
  return map;
}

/// From KeyFrame::points and KeyFrame::parent to the other ends. Keyframes come ascending, as observations
/// shall be.
void MapData::RelinkKeyFrames() {
  for (KeyFrame& keyframe : MutableKeyFrames()) {
    if (keyframe.parent.IsValid()) Find(keyframe.parent)->children.insert(keyframe.id);
    for (size_t i = 0; i < keyframe.points.size(); ++i) {
      if (MapPoint* point = Find(keyframe.points[i]))
        point->observations.push_back({keyframe.id, static_cast<int>(i)});
    }
  }
}

void MapData::RecountCovisibility() {
  std::vector<int> num_shared(keyframes_.size(), 0);  // index: id; zero again after each keyframe
  std::vector<KeyFrameId> others;
  for (KeyFrame& keyframe : MutableKeyFrames()) {
    others.clear();
    for (const MapPointId id : keyframe.points) {
      if (!id.IsValid()) continue;
      for (const Observation& seen : Find(id)->observations) {
        if (seen.keyframe != keyframe.id && num_shared[seen.keyframe.value]++ == 0)
          others.push_back(seen.keyframe);
      }
    }
    std::ranges::sort(others);
    keyframe.covisibles.clear();
    for (const KeyFrameId other : others) {
      keyframe.covisibles.push_back({other, std::exchange(num_shared[other.value], 0)});
    }
  }
}

}  // namespace orbslam
