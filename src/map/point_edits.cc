// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "orbslam/map/map_data.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

auto FindObservation(std::vector<Observation>& observations, KeyFrameId keyframe) {
  return std::ranges::lower_bound(observations, keyframe, {}, &Observation::keyframe);
}

}  // namespace

MapPointId MapData::AddMapPoint(const Eigen::Vector3d& position_world, KeyFrameId created_by) {
  auto point = std::make_unique<MapPoint>();
  point->id = MapPointId(static_cast<uint32_t>(points_.size()));
  point->position_world = position_world;
  point->created_by = created_by;
  points_.push_back(std::move(point));
  ++num_points_;
  return points_.back()->id;
}

const MapPoint* MapData::Find(MapPointId id) const {
  return id.value < points_.size() ? points_[id.value].get() : nullptr;
}

MapPoint* MapData::Find(MapPointId id) {
  return const_cast<MapPoint*>(static_cast<const MapData*>(this)->Find(id));
}

MapPointId MapData::Resolve(MapPointId id) const {
  while (id.IsValid() && Find(id) == nullptr) {
    const auto found = fused_into_.find(id);
    if (found == fused_into_.end()) return {};
    id = found->second;
  }
  return id;
}

void MapData::EraseMapPoint(MapPointId id) {
  if (Find(id) == nullptr) return;
  while (Find(id) != nullptr && !Find(id)->observations.empty()) {
    RemoveObservation(id, Find(id)->observations.back().keyframe);
  }
  if (Find(id) == nullptr) return;  // its last observation took it along
  points_[id.value].reset();
  --num_points_;
}

void MapData::FuseMapPoint(MapPointId from, MapPointId into) {
  MapPoint *source = Find(from), *target = Find(into);
  if (from == into || source == nullptr || target == nullptr) return;
  target->times_visible += source->times_visible;
  target->times_found += source->times_found;
  const std::vector<Observation> observations = source->observations;
  EraseMapPoint(from);
  fused_into_[from] = into;
  for (const auto& [keyframe, keypoint] : observations) AddObservation(into, keyframe, keypoint);
  RefreshMapPoint(into);
}

bool MapData::AddObservation(MapPointId point_id, KeyFrameId keyframe_id, int keypoint) {
  MapPoint* point = Find(point_id);
  KeyFrame* keyframe = Find(keyframe_id);
  ORBSLAM_CHECK(point != nullptr && keyframe != nullptr && keypoint >= 0 &&
                keypoint < keyframe->features->size());
  const auto place = FindObservation(point->observations, keyframe_id);
  const bool is_seen = place != point->observations.end() && place->keyframe == keyframe_id;
  if (is_seen || keyframe->points[keypoint].IsValid()) return false;
  for (const Observation& other : point->observations) {
    ChangeCovisibility(keyframe_id, other.keyframe, +1);
    ChangeCovisibility(other.keyframe, keyframe_id, +1);
  }
  point->observations.insert(place, {keyframe_id, keypoint});
  keyframe->points[keypoint] = point_id;
  return true;
}

void MapData::RemoveObservation(MapPointId point_id, KeyFrameId keyframe_id) {
  MapPoint* point = Find(point_id);
  if (point == nullptr) return;
  const auto place = FindObservation(point->observations, keyframe_id);
  if (place == point->observations.end() || place->keyframe != keyframe_id) return;
  Find(keyframe_id)->points[place->keypoint] = MapPointId();
  point->observations.erase(place);
  for (const Observation& other : point->observations) {
    ChangeCovisibility(keyframe_id, other.keyframe, -1);
    ChangeCovisibility(other.keyframe, keyframe_id, -1);
  }
  if (point->observations.empty()) {
    points_[point_id.value].reset();
    --num_points_;
  }
}

void MapData::RefreshMapPoint(MapPointId id) {
  MapPoint* point = Find(id);
  if (point == nullptr || point->observations.empty()) return;
  std::vector<Descriptor> descriptors;
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  for (const auto& [keyframe_id, keypoint] : point->observations) {
    const KeyFrame* keyframe = Find(keyframe_id);
    descriptors.push_back(keyframe->features->descriptors[keypoint]);
    directions += (point->position_world - keyframe->CenterWorld()).normalized();
  }
  point->descriptor = descriptors[MedoidIndex(descriptors)];
  point->normal_world = directions.normalized();
  // The range in which some pyramid level shows the point at the scale at which it was first seen
  // (ORB-SLAM 2015, section III-C), from the oldest observation.
  const auto& [oldest, keypoint] = point->observations.front();
  const double distance_m = (point->position_world - Find(oldest)->CenterWorld()).norm();
  const int level = Find(oldest)->features->levels[keypoint];
  point->max_distance_m = distance_m * pyramid_.Scale(level);
  point->min_distance_m = point->max_distance_m / pyramid_.Scale(pyramid_.num_levels() - 1);
}

}  // namespace orbslam
