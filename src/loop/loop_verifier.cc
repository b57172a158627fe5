// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_verifier.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "orbslam/matching/word_search.h"
#include "orbslam/optimization/relative_pose.h"
#include "orbslam/pipeline/point_view.h"

namespace orbslam {
namespace {

/// A keyframe's copy to work on without a guard.
struct Side {
  Rigid3d camera_from_world;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<char> has_point;          // one a keypoint
  std::vector<MapPointId> point_ids;    // likewise
  std::vector<Eigen::Vector3d> points;  // likewise, in the camera's frame
};

Side CopySide(const MapData& map, const KeyFrame& keyframe) {
  Side side{keyframe.camera_from_world, keyframe.features, {}, keyframe.points, {}};
  for (const MapPointId id : keyframe.points) {
    const MapPoint* point = map.Find(id);
    side.has_point.push_back(point != nullptr);
    side.points.push_back(point != nullptr ? keyframe.camera_from_world * point->position_world
                                           : Eigen::Vector3d::Zero());
  }
  return side;
}

/// The points of the old keyframe's neighbourhood, copied.
std::vector<MapPoint> CopyPointsAround(const MapData& map, const KeyFrame& keyframe, int min_shared) {
  std::set<MapPointId> ids;
  std::vector<KeyFrameId> group = keyframe.BestCovisibles(std::numeric_limits<int>::max(), min_shared);
  group.push_back(keyframe.id);
  for (const KeyFrameId id : group) {
    std::ranges::copy_if(map.Find(id)->points, std::inserter(ids, ids.end()), &MapPointId::IsValid);
  }
  std::vector<MapPoint> points;
  std::ranges::transform(ids, std::back_inserter(points), [&](MapPointId id) { return *map.Find(id); });
  return points;
}

/// matches: for every keypoint of current, the keypoint of old or -1.
RelativePoseProblem MakeProblem(const Sensor& sensor, const Side& current, const Side& old,
                                const std::vector<int>& matches) {
  RelativePoseProblem problem{.intrinsics = sensor.intrinsics};
  for (size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0) continue;
    const cv::Point2f &pixel = current.features->pixels[i], &old_pixel = old.features->pixels[matches[i]];
    problem.matches.push_back(
        {.point_a = old.points[matches[i]],
         .point_b = current.points[i],
         .pixel_a = {old_pixel.x, old_pixel.y},
         .pixel_b = {pixel.x, pixel.y},
         .inverse_variance_a = sensor.pyramid.InverseVariance(old.features->levels[matches[i]]),
         .inverse_variance_b = sensor.pyramid.InverseVariance(current.features->levels[i])});
  }
  return problem;
}

/// Looks for `points` in the current keyframe where the estimate puts them.
std::vector<LoopPoint> SearchGuided(const Sensor& sensor, const Side& current,
                                    const Rigid3d& camera_from_world, const std::vector<MapPoint>& points,
                                    double radius_px) {
  PointQueries wanted;
  for (const MapPoint& point : points) wanted.Add(point, camera_from_world, sensor, radius_px);
  const std::vector<int> match =
      SearchByProjection(wanted.queries, *current.features, {}, {.max_distance = kStrictMaxDistance});
  std::vector<LoopPoint> found;
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] >= 0) found.push_back({match[q], wanted.points[q]});
  }
  std::ranges::sort(found, {}, &LoopPoint::keypoint);
  return found;
}

/// The matches among `found` whose keypoint has a point of its own, as keypoint pairs for refinement.
std::vector<int> AsKeypointMatches(const std::vector<LoopPoint>& found, const Side& current,
                                   const Side& old) {
  std::map<MapPointId, int> keypoint_of;
  for (int i = 0; i < std::ssize(old.point_ids); ++i) {
    if (old.has_point[i]) keypoint_of[old.point_ids[i]] = i;
  }
  std::vector<int> matches(current.has_point.size(), -1);
  for (const auto& [keypoint, point] : found) {
    const auto old_keypoint = keypoint_of.find(point);
    if (current.has_point[keypoint] && old_keypoint != keypoint_of.end())
      matches[keypoint] = old_keypoint->second;
  }
  return matches;
}

}  // namespace

std::optional<Loop> VerifyLoop(const LoopOptions& options, const Sensor& sensor, const PlaceIndex& places,
                               const Map& map, KeyFrameId current_id, KeyFrameId old_id) {
  const auto current_words = places.Find(current_id), old_words = places.Find(old_id);
  if (current_words == nullptr || old_words == nullptr) return std::nullopt;
  Side current, old;
  std::vector<MapPoint> points_around;
  {
    const auto guard = map.Read();
    if (guard->Find(current_id) == nullptr || guard->Find(old_id) == nullptr) return std::nullopt;
    current = CopySide(*guard, *guard->Find(current_id));
    old = CopySide(*guard, *guard->Find(old_id));
    points_around = CopyPointsAround(*guard, *guard->Find(old_id), options.min_shared_points);
  }
  const std::vector<int> by_words =
      SearchByWords(*current.features, current_words->direct_index, current.has_point, *old.features,
                    old_words->direct_index, old.has_point, {.max_ratio = 0.75});
  if (std::ranges::count_if(by_words, [](int m) { return m >= 0; }) < options.min_word_matches)
    return std::nullopt;

  RelativePoseOptions relative;
  relative.min_inliers = options.min_inliers;
  Rng rng(/*seed=*/0, current_id.value, /*purpose=*/old_id.value);
  const auto estimate = EstimateRelativePose(MakeProblem(sensor, current, old, by_words), relative, &rng);
  if (!estimate) return std::nullopt;
  const auto second_look = SearchGuided(sensor, current, estimate->b_from_a * old.camera_from_world,
                                        points_around, options.guided_radius_px);
  const RelativePoseResult refined =
      RefineRelativePose(MakeProblem(sensor, current, old, AsKeypointMatches(second_look, current, old)),
                         estimate->b_from_a, relative);
  if (refined.num_inliers < options.min_inliers) return std::nullopt;

  Loop loop{current_id, old_id, refined.b_from_a, {}};
  loop.points = SearchGuided(sensor, current, loop.current_from_old * old.camera_from_world, points_around,
                             options.neighbor_radius_px);
  if (std::ssize(loop.points) < options.min_total_matches) return std::nullopt;
  return loop;
}

}  // namespace orbslam
