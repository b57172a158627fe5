// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/local_map_tracker.h"

#include <algorithm>
#include <map>

#include "orbslam/pipeline/point_view.h"
#include "orbslam/tracking/pose_refinement.h"

namespace orbslam {

LocalMapTracker::Result LocalMapTracker::Track(const MovingRegion& moving, Frame* frame,
                                               PointCounter* counter) {
  Result result;
  {
    const auto guard = map_.Read();
    const std::vector<KeyFrameId> keyframes = LocalKeyFrames(*guard, *frame);
    if (keyframes.empty()) return result;
    result.reference = keyframes.front();
    CollectCandidates(*guard, *frame, keyframes, moving, &result);
  }
  MatchCandidates(frame, counter);
  const std::vector<MapPointId> matched = frame->points;
  result.num_inliers = RefinePose(map_, sensor_, NearPointsOf(options_, *frame), frame);
  if (frame->moving_below_m > 0) CollectContradicted(*map_.Read(), matched, *frame, &result);
  for (const MapPointId id : frame->points) {
    if (id.IsValid()) counter->CountFound(id);
  }
  return result;
}

void LocalMapTracker::CollectContradicted(const MapData& map, const std::vector<MapPointId>& matched,
                                          const Frame& frame, Result* result) {
  for (size_t i = 0; i < matched.size(); ++i) {
    const MapPoint* point = map.Find(map.Resolve(matched[i]));
    if (point == nullptr || frame.points[i].IsValid()) continue;
    if ((frame.camera_from_world * point->position_world).z() < frame.moving_below_m)
      result->near_moving.push_back(point->id);
  }
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
    if (std::ssize(local) < options_.max_local_keyframes && id.IsValid() &&
        std::ranges::count(local, id) == 0) {
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
                                        const std::vector<KeyFrameId>& keyframes, const MovingRegion& moving,
                                        Result* result) {
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
  for (const KeyFrameId keyframe : keyframes) {
    for (const MapPointId id : map.Find(keyframe)->points) {
      if (!id.IsValid() || !is_new(id)) continue;
      const MapPoint& point = *map.Find(id);
      auto view = PredictView(point, frame.camera_from_world, sensor_, options_.min_view_cos);
      if (!view) continue;
      const Eigen::Vector3d x_camera = frame.camera_from_world * point.position_world;
      if (moving.Covers(x_camera)) {
        if (moving.Shows(x_camera)) result->on_moving.push_back(id);
        if (moving.MayShow(x_camera)) result->near_moving.push_back(id);
        continue;
      }
      if (moving.SeesThrough(x_camera)) result->seen_through.push_back(id);
      const bool is_head_on = view->view_cos > 0.998;
      view->query.radius_px *=
          static_cast<float>(options_.local_radius_factor *
                             (is_head_on ? options_.local_radius_px : options_.local_radius_oblique_px));
      queries_.push_back(view->query);
      candidates_.push_back(id);
    }
  }
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
