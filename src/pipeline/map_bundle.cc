// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/map_bundle.h"

#include <algorithm>
#include <map>

namespace orbslam {
namespace {

std::set<MapPointId> PointsSeenBy(const MapData& map, const std::set<KeyFrameId>& keyframes) {
  std::set<MapPointId> points;
  for (const KeyFrameId id : keyframes) {
    for (const MapPointId point : map.Find(id)->points) {
      if (point.IsValid()) points.insert(points.end(), point);
    }
  }
  return points;
}

std::vector<KeyFrameId> OtherObservers(const MapData& map, const std::set<MapPointId>& points,
                                       const std::set<KeyFrameId>& moving, int max_count) {
  std::map<KeyFrameId, int> count;
  for (const MapPointId id : points) {
    for (const Observation& observation : map.Find(id)->observations) ++count[observation.keyframe];
  }
  std::vector<std::pair<int, KeyFrameId>> ranked;
  for (const auto& [keyframe, n] : count) {
    if (!moving.contains(keyframe)) ranked.emplace_back(-n, keyframe);
  }
  std::ranges::sort(ranked);
  if (std::ssize(ranked) > max_count) ranked.resize(max_count);
  std::vector<KeyFrameId> observers;
  for (const auto& [n, keyframe] : ranked) observers.push_back(keyframe);
  return observers;
}

}  // namespace

MapBundle GatherBundle(const MapData& map, const Sensor& sensor, const std::set<KeyFrameId>& moving,
                       int max_fixed) {
  MapBundle bundle{.problem = {.intrinsics = sensor.intrinsics}, .epoch = map.epoch()};
  const std::set<MapPointId> points = PointsSeenBy(map, moving);
  std::map<KeyFrameId, int> index_of;
  const auto add_pose = [&](KeyFrameId id, bool is_fixed) {
    index_of[id] = static_cast<int>(bundle.keyframes.size());
    bundle.keyframes.push_back(id);
    bundle.problem.poses.push_back({map.Find(id)->camera_from_world, is_fixed});
  };
  for (const KeyFrameId id : moving) add_pose(id, !map.Find(id)->parent.IsValid());
  for (const KeyFrameId id : OtherObservers(map, points, moving, max_fixed)) add_pose(id, true);

  for (const MapPointId id : points) {
    const MapPoint& point = *map.Find(id);
    const int point_index = static_cast<int>(bundle.points.size());
    bundle.points.push_back(id);
    bundle.problem.points.push_back(point.position_world);
    for (const auto& [keyframe, keypoint] : point.observations) {
      const auto pose = index_of.find(keyframe);
      if (pose == index_of.end()) continue;
      const FrameFeatures& features = *map.Find(keyframe)->features;
      const cv::Point2f& pixel = features.pixels[keypoint];
      bundle.problem.observations.push_back({pose->second,
                                             point_index,
                                             {pixel.x, pixel.y, features.right_u[keypoint]},
                                             sensor.pyramid.InverseVariance(features.levels[keypoint])});
    }
  }
  return bundle;
}

void AddFrame(const MapData& map, const Sensor& sensor, const PastFrame& frame, MapBundle* bundle) {
  const auto reference_from_world = map.CameraFromWorld(frame.reference);
  if (!reference_from_world) return;
  BundleProblem& problem = bundle->problem;
  const int pose = static_cast<int>(problem.poses.size());
  problem.poses.push_back({frame.camera_from_reference * *reference_from_world, false});
  for (const Sighting& sighting : frame.sightings) {
    const auto point = std::ranges::lower_bound(bundle->points, map.Resolve(sighting.point));
    if (point == bundle->points.end() || *point != map.Resolve(sighting.point)) continue;
    problem.observations.push_back({pose, static_cast<int>(point - bundle->points.begin()),
                                    sighting.pixel.cast<double>(),
                                    sensor.pyramid.InverseVariance(sighting.level)});
  }
}

bool ApplyBundle(const MapBundle& bundle, const BundleSummary& summary, MapData* map) {
  if (map->epoch() != bundle.epoch || !summary.is_usable) return false;
  const BundleProblem& problem = bundle.problem;
  for (size_t i = 0; i < bundle.keyframes.size(); ++i) {
    KeyFrame* keyframe = map->Find(bundle.keyframes[i]);
    if (keyframe != nullptr && !problem.poses[i].is_fixed) {
      keyframe->camera_from_world = problem.poses[i].camera_from_world;
    }
  }
  for (size_t i = 0; i < problem.observations.size(); ++i) {
    const BundleObservation& outlier = problem.observations[i];
    if (summary.is_inlier[i] || outlier.pose >= std::ssize(bundle.keyframes)) continue;
    map->RemoveObservation(bundle.points[outlier.point], bundle.keyframes[outlier.pose]);
  }
  for (size_t i = 0; i < bundle.points.size(); ++i) {
    MapPoint* point = map->Find(bundle.points[i]);
    if (point == nullptr) continue;
    point->position_world = problem.points[i];
    map->RefreshMapPoint(point->id);
  }
  return true;
}

}  // namespace orbslam
