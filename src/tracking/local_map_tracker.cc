// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/local_map_tracker.h"

#include <algorithm>
#include <map>

#include "orbslam/tracking/pose_refinement.h"

namespace orbslam {

LocalMapTracker::Result LocalMapTracker::Track(Frame* frame, PointCounter* counter) {
  Result result;
  {
    const auto guard = map_.Read();
    const std::vector<KeyFrameId> keyframes = LocalKeyFrames(*guard, *frame);
    if (keyframes.empty()) return result;
    result.reference = keyframes.front();
    CollectCandidates(*guard, *frame, keyframes);
  }
  MatchCandidates(frame, counter);
  result.num_inliers = RefinePose(map_, sensor_, frame);
  for (const MapPointId id : frame->points) {
    if (id.IsValid()) counter->CountFound(id);
  }
  return result;
}

std::vector<KeyFrameId> LocalMapTracker::LocalKeyFrames(const MapData& map, const Frame& frame) const {
  std::map<KeyFrameId, int> votes;
  for (const MapPointId id : frame.points) {
    const MapPoint* point = id.IsValid() ? map.Find(id) : nullptr;
    if (point == nullptr) continue;
    for (const Observation& observation : point->observations) ++votes[observation.keyframe];
  }
  std::vector<std::pair<int, KeyFrameId>> ranked;
  for (const auto& [keyframe, count] : votes) ranked.emplace_back(-count, keyframe);
  std::ranges::sort(ranked);
  std::vector<KeyFrameId> local;
  const auto add = [&](KeyFrameId id) {
    if (std::ssize(local) < options_.max_local_keyframes && id.IsValid() && std::ranges::count(local, id) == 0) {
      local.push_back(id);
    }
  };
  for (const auto& [count, id] : ranked) add(id);
  const size_t num_voted = local.size();
  for (size_t i = 0; i < num_voted && std::ssize(local) < options_.max_local_keyframes; ++i) {
    const KeyFrame* keyframe = map.Find(local[i]);
    for (const KeyFrameId neighbor : keyframe->BestCovisibles(options_.local_neighbors)) add(neighbor);
    for (const KeyFrameId child : keyframe->children) add(child);
    add(keyframe->parent);
  }
  return local;
}

void LocalMapTracker::CollectCandidates(const MapData& map, const Frame& frame,
                                        const std::vector<KeyFrameId>& keyframes) {
  ++visit_;
  queries_.clear();
  candidates_.clear();
  const auto is_new = [&](MapPointId id) {
    if (id.value >= last_visit_.size()) last_visit_.resize(2 * id.value + 1, 0);
    return std::exchange(last_visit_[id.value], visit_) != visit_;
  };
  for (const MapPointId id : frame.points) {
    if (id.IsValid()) is_new(id);
  }
  const Eigen::Vector3d center_world = Inverse(frame.camera_from_world).translation;
  for (const KeyFrameId keyframe : keyframes) {
    for (const MapPointId id : map.Find(keyframe)->points) {
      if (!id.IsValid() || !is_new(id)) continue;
      const auto query = Predict(*map.Find(id), frame, center_world);
      if (!query) continue;
      queries_.push_back(*query);
      candidates_.push_back(id);
    }
  }
}

std::optional<ProjectionQuery> LocalMapTracker::Predict(const MapPoint& point, const Frame& frame,
                                                        const Eigen::Vector3d& center_world) const {
  const Eigen::Vector3d x_camera = frame.camera_from_world * point.position_world;
  if (x_camera.z() <= 0) return std::nullopt;
  const Eigen::Vector3f pixel = sensor_.intrinsics.Project(x_camera).cast<float>();
  if (!sensor_.bounds.Contains(pixel.x(), pixel.y())) return std::nullopt;
  const Eigen::Vector3d view = point.position_world - center_world;
  const double distance_m = view.norm();
  if (distance_m < 0.8 * point.min_distance_m || distance_m > 1.2 * point.max_distance_m) return std::nullopt;
  const double view_cos = view.dot(point.normal_world) / distance_m;
  if (view_cos < options_.max_viewing_angle_cos) return std::nullopt;
  const int level = sensor_.pyramid.PredictLevel(point.max_distance_m, distance_m);
  const double radius_px = view_cos > 0.998 ? options_.local_radius_px : options_.local_radius_oblique_px;
  return ProjectionQuery{
      .descriptor = point.descriptor,
      .u = pixel.x(),
      .v = pixel.y(),
      .right_u = pixel.z(),
      .radius_px = static_cast<float>(radius_px * options_.local_radius_factor * sensor_.pyramid.Scale(level)),
      .min_level = level - 1,
      .max_level = level};
}

void LocalMapTracker::MatchCandidates(Frame* frame, PointCounter* counter) {
  std::vector<char> is_taken(frame->points.size());
  std::ranges::transform(frame->points, is_taken.begin(), [](MapPointId id) { return id.IsValid(); });
  for (const MapPointId id : frame->points) {
    if (id.IsValid()) counter->CountVisible(id);
  }
  for (const MapPointId id : candidates_) counter->CountVisible(id);
  const std::vector<int> match =
      SearchByProjection(queries_, *frame->features, is_taken,
                         {.max_distance = kLooseMaxDistance, .max_ratio = options_.max_ratio_local});
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] >= 0) frame->points[match[q]] = candidates_[q];
  }
}

}  // namespace orbslam
