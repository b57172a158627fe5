// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/mapping/point_creator.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "orbslam/geometry/triangulation.h"
#include "orbslam/matching/epipolar_search.h"
#include "orbslam/pipeline/point_view.h"

namespace orbslam {
namespace {

/// A keyframe's copy to work on without a guard.
struct View {
  KeyFrameId id;
  Rigid3d camera_from_world;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<int> free_keypoints;  // without a map point
};

View CopyView(const KeyFrame& keyframe) {
  View view{keyframe.id, keyframe.camera_from_world, keyframe.features, {}};
  for (int i = 0; i < keyframe.features->size(); ++i) {
    if (!keyframe.points[i].IsValid()) view.free_keypoints.push_back(i);
  }
  return view;
}

Eigen::Vector3d Direction(const Sensor& sensor, const View& view, int i) {
  return sensor.camera.Unproject(view.features->pixels[i].x, view.features->pixels[i].y, 1.0);
}

Eigen::Matrix3d FundamentalMatrix(const Sensor& sensor, const Rigid3d& b_from_a) {
  Eigen::Matrix3d direction_from_pixel;
  const StereoIntrinsics& k = sensor.intrinsics;
  direction_from_pixel << 1 / k.fx, 0, -k.cx / k.fx, 0, 1 / k.fy, -k.cy / k.fy, 0, 0, 1;
  return direction_from_pixel.transpose() * EssentialMatrix(b_from_a) * direction_from_pixel;
}

/// Cosine of the angle at which the eyes of the virtual stereo pair see a point at this depth; 1 without
/// depth.
double DepthParallaxCos(const Sensor& sensor, const View& view, int i) {
  if (!view.features->HasDepth(i)) return 1.0;
  const double baseline_m = sensor.intrinsics.bf / sensor.intrinsics.fx;
  return std::cos(2.0 * std::atan2(0.5 * baseline_m, view.features->depths_m[i]));
}

bool Reprojects(const Sensor& sensor, const View& view, int i, const Eigen::Vector3d& x_world) {
  return IsWithinGate(sensor, view.camera_from_world * x_world, *view.features, i);
}

/// The ratio of the distances must be that of the pyramid levels, within a level and a half.
bool ScalesAgree(const Sensor& sensor, const View& a, int i, const View& b, int j,
                 const Eigen::Vector3d& x_world) {
  const double distance_ratio =
      (a.camera_from_world * x_world).norm() / (b.camera_from_world * x_world).norm();
  const double level_ratio =
      sensor.pyramid.Scale(b.features->levels[j]) / sensor.pyramid.Scale(a.features->levels[i]);
  const double tolerance = 1.5 * sensor.pyramid.Scale(sensor.pyramid.num_levels() > 1 ? 1 : 0);
  return distance_ratio * tolerance > level_ratio && distance_ratio < level_ratio * tolerance;
}

std::optional<Eigen::Vector3d> LocatePoint(const Sensor& sensor, const MappingOptions& options, const View& a,
                                           int i, const View& b, int j) {
  const Rigid3d a_from_b = a.camera_from_world * Inverse(b.camera_from_world);
  const Eigen::Vector3d direction_a = Direction(sensor, a, i), direction_b = Direction(sensor, b, j);
  const double ray_cos = direction_a.normalized().dot((a_from_b.rotation * direction_b).normalized());
  const double depth_cos_a = DepthParallaxCos(sensor, a, i), depth_cos_b = DepthParallaxCos(sensor, b, j);
  const auto world = [](const View& view, const Eigen::Vector3d& x) {
    return Inverse(view.camera_from_world) * x;
  };
  if (ray_cos > 0 && ray_cos < std::min(depth_cos_a, depth_cos_b) && ray_cos < options.min_parallax_cos) {
    const auto x_a = TriangulateMidpoint(a_from_b, direction_a, direction_b);
    return x_a ? std::optional(world(a, *x_a)) : std::nullopt;
  }
  if (depth_cos_a < depth_cos_b) return world(a, direction_a * static_cast<double>(a.features->depths_m[i]));
  if (depth_cos_b < 1.0) return world(b, direction_b * static_cast<double>(b.features->depths_m[j]));
  return std::nullopt;
}

struct NewPoint {
  Eigen::Vector3d x_world;
  int keypoint_a, keypoint_b;
};

std::vector<NewPoint> LocatePoints(const Sensor& sensor, const MappingOptions& options, const View& a,
                                   const View& b) {
  const Rigid3d b_from_a = b.camera_from_world * Inverse(a.camera_from_world);
  if (b_from_a.translation.norm() < sensor.intrinsics.bf / sensor.intrinsics.fx)
    return {};  // depth knows better
  const std::vector<int> match =
      SearchByEpipolarLine(*a.features, a.free_keypoints, *b.features, b.free_keypoints,
                           FundamentalMatrix(sensor, b_from_a), sensor.pyramid);
  std::vector<NewPoint> found;
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] < 0) continue;
    const int i = a.free_keypoints[q], j = match[q];
    const auto x_world = LocatePoint(sensor, options, a, i, b, j);
    if (x_world && Reprojects(sensor, a, i, *x_world) && Reprojects(sensor, b, j, *x_world) &&
        ScalesAgree(sensor, a, i, b, j, *x_world)) {
      found.push_back({*x_world, i, j});
    }
  }
  return found;
}

}  // namespace

std::vector<MapPointId> CreatePoints(const Sensor& sensor, const MappingOptions& options,
                                     KeyFrameId keyframe_id, Map* map) {
  std::vector<MapPointId> created;
  std::vector<KeyFrameId> neighbors;
  {
    const auto guard = map->Read();
    const KeyFrame* keyframe = guard->Find(keyframe_id);
    if (keyframe == nullptr) return created;
    neighbors = keyframe->BestCovisibles(options.triangulation_neighbors);
  }
  for (const KeyFrameId neighbor_id : neighbors) {
    std::optional<View> a, b;
    {
      const auto guard = map->Read();
      if (guard->Find(keyframe_id) == nullptr || guard->Find(neighbor_id) == nullptr) continue;
      a = CopyView(*guard->Find(keyframe_id));
      b = CopyView(*guard->Find(neighbor_id));
    }
    const std::vector<NewPoint> found = LocatePoints(sensor, options, *a, *b);
    const auto guard = map->Write();
    if (guard->Find(keyframe_id) == nullptr || guard->Find(neighbor_id) == nullptr) continue;
    for (const auto& [x_world, keypoint_a, keypoint_b] : found) {
      const bool is_free = !guard->Find(keyframe_id)->points[keypoint_a].IsValid() &&
                           !guard->Find(neighbor_id)->points[keypoint_b].IsValid();
      if (!is_free) continue;
      const MapPointId id = guard->AddMapPoint(x_world, keyframe_id);
      guard->AddObservation(id, keyframe_id, keypoint_a);
      guard->AddObservation(id, neighbor_id, keypoint_b);
      guard->RefreshMapPoint(id);
      created.push_back(id);
    }
  }
  return created;
}

}  // namespace orbslam
