// SPDX-License-Identifier: GPL-3.0-or-later
#include "tracked_corner.h"

#include <algorithm>

namespace orbslam {
namespace {

constexpr float kNearM = 0.3f, kFarM = 30.f;  // where what has no depth can be; nearer, nothing is in focus
constexpr float kGuessM = 3.f;                // its flow is then mostly that of the rotation

Eigen::Vector3f Point(const GridCamera& camera, cv::Point2f pixel, float depth_m) {
  return {(pixel.x - camera.cx) / camera.fx * depth_m, (pixel.y - camera.cy) / camera.fy * depth_m, depth_m};
}

cv::Point2f Project(const GridCamera& camera, const Rigid3d& pose, const Eigen::Vector3f& x) {
  const Eigen::Vector3d q = pose * x.cast<double>();
  const double z = std::max(q.z(), 0.05);
  return {static_cast<float>(camera.fx * q.x() / z + camera.cx),
          static_cast<float>(camera.fy * q.y() / z + camera.cy)};
}

/// From the nearest point of the segment between a and b to p.
cv::Point2f FromSegment(cv::Point2f p, cv::Point2f a, cv::Point2f b) {
  const cv::Point2f along = b - a, offset = p - a;
  const float length2 = along.dot(along);
  const float share = length2 > 0 ? std::clamp(offset.dot(along) / length2, 0.f, 1.f) : 0.f;
  return offset - share * along;
}

/// At an edge whose depth a corner has cannot be told; among too few measured cells there is one.
void SetDepth(const ReferenceView& earlier, Baseline baseline, TrackedCorner* corner) {
  const int u = static_cast<int>(corner->previous.x) / 2, v = static_cast<int>(corner->previous.y) / 2;
  corner->depth_m = corner->nearest_m = corner->farthest_m = earlier.frame->depth_m(v, u);
  if (!(corner->depth_m > 0)) corner->nearest_m = kNearM, corner->farthest_m = kFarM;
  if (baseline == Baseline::kShort || !(corner->depth_m > 0)) return;
  const float nearest_m = earlier.envelope_m(v, u)[0], farthest_m = earlier.envelope_m(v, u)[1];
  if (!(nearest_m > 0))
    corner->nearest_m = kNearM, corner->farthest_m = kFarM;
  else if (farthest_m - nearest_m > MaxSurfaceStepM(nearest_m))
    corner->nearest_m = nearest_m, corner->farthest_m = farthest_m;
}

/// How a patch that faces the camera turns and grows on the way.
cv::Matx22f PreviousFromCurrent(const GridCamera& camera, const Rigid3d& motion, cv::Point2f previous,
                                cv::Point2f current, float depth_m) {
  constexpr float kStep = 5.f;  // grey px: about half a patch
  const auto moved = [&](cv::Point2f step) {
    return (Project(camera, motion, Point(camera, previous + step, depth_m)) - current) / kStep;
  };
  const cv::Point2f right = moved({kStep, 0}), down = moved({0, kStep});
  return cv::Matx22f(right.x, down.x, right.y, down.y).inv();
}

}  // namespace

std::vector<TrackedCorner> FollowCorners(const WorkingGrids& grids, const ReferenceView& earlier,
                                         const WorkingFrame& current, const Rigid3d& motion,
                                         Baseline baseline, const FlowOptions& options) {
  const WorkingFrame& before = *earlier.frame;
  std::vector<TrackedCorner> corners;
  std::vector<FlowQuery> queries;
  for (const cv::Point2f& position : before.corners) {
    const int u = static_cast<int>(position.x) / 2, v = static_cast<int>(position.y) / 2;
    TrackedCorner corner;
    corner.previous = position;
    SetDepth(earlier, baseline, &corner);
    corner.was_moving = earlier.moving(v, u) != 0;
    const float depth_m = corner.depth_m > 0 ? corner.depth_m : kGuessM;
    FlowQuery query{position, Project(grids.gray, motion, Point(grids.gray, position, depth_m)), {}};
    if (baseline == Baseline::kLong)
      query.first_from_second = PreviousFromCurrent(grids.gray, motion, position, query.predicted, depth_m);
    corners.push_back(corner), queries.push_back(query);
  }
  const std::vector<FlowResult> flow = TrackPatches(before.pyramid, current.pyramid, queries, options);
  std::vector<TrackedCorner> tracked;
  for (size_t i = 0; i < flow.size(); ++i) {
    if (!flow[i].ok) continue;
    corners[i].current = flow[i].position;
    tracked.push_back(corners[i]);
  }
  return tracked;
}

void MeasureExcess(const GridCamera& gray_camera, const Rigid3d& current_from_previous,
                   std::vector<TrackedCorner>* corners) {
  for (TrackedCorner& corner : *corners) {
    const auto at = [&](float depth_m) {
      return Project(gray_camera, current_from_previous, Point(gray_camera, corner.previous, depth_m));
    };
    corner.excess = FromSegment(corner.current, at(corner.farthest_m), at(corner.nearest_m));
    corner.residual_px = static_cast<float>(cv::norm(corner.excess));
  }
}

std::vector<CornerMatch> RestingMatches(const GridCamera& gray_camera,
                                        std::span<const TrackedCorner> corners) {
  std::vector<CornerMatch> matches;
  for (const TrackedCorner& corner : corners)
    if (corner.IsResting())
      matches.push_back(
          {Point(gray_camera, corner.previous, corner.depth_m), {corner.current.x, corner.current.y}});
  return matches;
}

std::optional<float> RestingResidualPx(std::span<const TrackedCorner> corners, double quantile,
                                       int min_corners) {
  std::vector<float> residuals;
  for (const TrackedCorner& corner : corners)
    if (corner.IsResting()) residuals.push_back(corner.residual_px);
  if (residuals.empty() || static_cast<int>(residuals.size()) < min_corners) return {};
  const auto rank = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(residuals.size()));
  std::nth_element(residuals.begin(), residuals.begin() + rank, residuals.end());
  return residuals[rank];
}

}  // namespace orbslam
