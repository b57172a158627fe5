// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/point_judge.h"

#include <set>

#include "orbslam/tracking/moving_region.h"

namespace orbslam {
namespace {

std::vector<std::pair<MapPointId, KeyFrameId>> RecentObservations(const MapData& map,
                                                                  const std::vector<MapPointId>& points,
                                                                  double since_s) {
  std::vector<std::pair<MapPointId, KeyFrameId>> recent;
  for (const MapPointId id : points) {
    const MapPoint* point = map.Find(id);
    if (point == nullptr) continue;
    for (const Observation& observation : point->observations) {
      if (map.Find(observation.keyframe)->timestamp_s > since_s)
        recent.emplace_back(id, observation.keyframe);
    }
  }
  return recent;
}

}  // namespace

void PointJudge::Judge(const LocalMapTracker::Result& found, const Frame& frame, const Frame* last) {
  for (const MapPointId id : found.on_moving) quarantine_.Refute(id);
  if (last != nullptr) RefuteSeenThrough(found.seen_through, frame, *last);
  for (const MapPointId id : frame.points) quarantine_.FoundStatic(id);
}

/// Depth is taken up to half a frame earlier or later than colour: what shifts by more than a rim from frame
/// to frame may have its depth elsewhere.
void PointJudge::RefuteSeenThrough(const std::vector<MapPointId>& seen_through, const Frame& frame,
                                   const Frame& last) {
  const auto guard = map_->Read();
  for (const MapPointId id : seen_through) {
    const MapPoint* point = guard->Find(id);
    if (point == nullptr) continue;
    const Eigen::Vector3d x_camera = frame.camera_from_world * point->position_world;
    const Eigen::Vector3d x_last = last.camera_from_world * point->position_world;
    const Eigen::Vector2d shift_px = sensor_.camera.Project(x_camera) - sensor_.camera.Project(x_last);
    if (x_last.z() > 0 && shift_px.norm() < MovingRegion::kRimPx) quarantine_.Refute(id);
  }
}

void PointJudge::Retract(const std::vector<MapPointId>& points, double since_s) {
  const auto recent = RecentObservations(*map_->Read(), points, since_s);
  if (recent.empty()) return;
  const auto guard = map_->Write();
  std::set<MapPointId> changed;
  for (const auto& [point, keyframe] : recent) {
    guard->RemoveObservation(point, keyframe);
    ++num_taken_[keyframe];
    changed.insert(point);
  }
  for (const MapPointId point : changed) guard->RefreshMapPoint(point);
}

void PointJudge::EraseCondemned() {
  const std::vector<MapPointId> condemned = quarantine_.TakeCondemned();
  if (condemned.empty()) return;
  const auto guard = map_->Write();
  for (const MapPointId id : condemned) {
    const MapPoint* point = guard->Find(id);
    if (point == nullptr) continue;
    for (const Observation& observation : point->observations) ++num_taken_[observation.keyframe];
    guard->EraseMapPoint(id);
  }
}

int PointJudge::NumTakenFrom(KeyFrameId keyframe) const {
  const auto found = num_taken_.find(keyframe);
  return found == num_taken_.end() ? 0 : found->second;
}

}  // namespace orbslam
