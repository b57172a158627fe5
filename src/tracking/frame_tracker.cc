// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/frame_tracker.h"

#include <algorithm>
#include <numeric>

#include "orbslam/matching/descriptor_search.h"
#include "orbslam/matching/projection_search.h"
#include "orbslam/tracking/pose_refinement.h"

namespace orbslam {
namespace {

struct Queries {
  std::vector<ProjectionQuery> queries;
  std::vector<MapPointId> points;
};

struct LevelRange {
  int min, max;
};

/// Which levels a point of `level` may be seen at now: an approaching camera sees it larger, a receding one
/// smaller.
LevelRange NextLevels(int level, double advance_m, double baseline_m) {
  constexpr int kMaxLevel = 1000;
  if (advance_m > baseline_m) return {level, kMaxLevel};
  if (advance_m < -baseline_m) return {0, level};
  return {level - 1, level + 1};
}

Queries ProjectLastFrame(const Map& map, const Sensor& sensor, const Frame& last, const Frame& frame,
                         double radius_px) {
  const double baseline_m = sensor.intrinsics.bf / sensor.intrinsics.fx;
  const double advance_m = (last.camera_from_world * Inverse(frame.camera_from_world)).translation.z();
  const FrameFeatures& features = *last.features;
  Queries result;
  const auto guard = map.Read();
  for (int i = 0; i < features.size(); ++i) {
    const MapPointId id = guard->Resolve(last.points[i]);
    if (!id.IsValid()) continue;
    const Eigen::Vector3d x_camera = frame.camera_from_world * guard->Find(id)->position_world;
    if (x_camera.z() <= 0) continue;
    const Eigen::Vector3f pixel = sensor.intrinsics.Project(x_camera).cast<float>();
    if (!sensor.bounds.Contains(pixel.x(), pixel.y())) continue;
    const auto [min_level, max_level] = NextLevels(features.levels[i], advance_m, baseline_m);
    const auto radius = static_cast<float>(radius_px * sensor.pyramid.Scale(features.levels[i]));
    result.queries.push_back({features.descriptors[i], pixel.x(), pixel.y(), pixel.z(), radius, min_level,
                              max_level, features.angles_deg[i]});
    result.points.push_back(id);
  }
  return result;
}

}  // namespace

int FrameTracker::TrackLastFrame(const Frame& last, Frame* frame) const {
  const ProjectionSearchOptions search{
      .max_distance = kLooseMaxDistance, .max_ratio = 1, .check_orientation = true};
  for (const double widening : {1.0, 2.0}) {
    const Queries projected =
        ProjectLastFrame(map_, sensor_, last, *frame, widening * options_.motion_radius_px);
    const std::vector<int> match = SearchByProjection(projected.queries, *frame->features, {}, search);
    if (std::ranges::count_if(match, [](int m) { return m >= 0; }) < options_.min_motion_matches) continue;
    frame->ForgetPoints();
    for (size_t q = 0; q < match.size(); ++q) {
      if (match[q] >= 0) frame->points[match[q]] = projected.points[q];
    }
    return RefinePose(map_, sensor_, NearPointsOf(options_, *frame), frame);
  }
  return 0;
}

int FrameTracker::TrackKeyFrame(KeyFrameId keyframe_id, Frame* frame) const {
  std::shared_ptr<const FrameFeatures> features;
  std::vector<MapPointId> points;
  std::vector<int> with_point;
  {
    const auto guard = map_.Read();
    const KeyFrame* keyframe = guard->Find(guard->Resolve(keyframe_id));
    if (keyframe == nullptr) return 0;
    features = keyframe->features;
    points = keyframe->points;
  }
  for (int i = 0; i < features->size(); ++i) {
    if (points[i].IsValid()) with_point.push_back(i);
  }
  std::vector<int> all(frame->features->size());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> match = SearchByDescriptor(*features, with_point, *frame->features, all,
                                                    {.max_ratio = options_.max_ratio_reference});
  frame->ForgetPoints();
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] >= 0) frame->points[match[q]] = points[with_point[q]];
  }
  return EstimatePose(map_, sensor_, frame);
}

}  // namespace orbslam
