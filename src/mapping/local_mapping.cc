// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/mapping/local_mapping.h"

#include <algorithm>
#include <set>

#include "orbslam/mapping/point_creator.h"
#include "orbslam/optimization/bundle_adjuster.h"
#include "orbslam/pipeline/map_bundle.h"
#include "orbslam/pipeline/point_fusion.h"

namespace orbslam {
namespace {

/// The keyframe's covisibles, and theirs: where its points may hide under other ids.
std::vector<KeyFrameId> FusionTargets(const MapData& map, const MappingOptions& options,
                                      KeyFrameId keyframe) {
  std::vector<KeyFrameId> targets;
  const auto add = [&](KeyFrameId id) {
    if (id != keyframe && std::ranges::count(targets, id) == 0) targets.push_back(id);
  };
  for (const KeyFrameId id : map.Find(keyframe)->BestCovisibles(options.fusion_neighbors)) {
    add(id);
    for (const KeyFrameId second : map.Find(id)->BestCovisibles(options.fusion_second_neighbors)) add(second);
  }
  return targets;
}

std::vector<MapPointId> PointsOf(const MapData& map, std::span<const KeyFrameId> keyframes) {
  std::vector<MapPointId> points;
  for (const KeyFrameId id : keyframes) {
    const KeyFrame* keyframe = map.Find(id);
    if (keyframe == nullptr) continue;
    std::ranges::copy_if(keyframe->points, std::back_inserter(points), &MapPointId::IsValid);
  }
  std::ranges::sort(points);
  points.erase(std::ranges::unique(points).begin(), points.end());
  return points;
}

}  // namespace

LocalMapping::LocalMapping(const Sensor& sensor, const MappingOptions& options, Map* map)
    : sensor_(sensor), options_(options), map_(map), point_culler_(options_) {}

KeyFrameMapped LocalMapping::Process(const KeyFrameReady& message, bool more_waiting, std::stop_token stop) {
  const KeyFrameId keyframe = message.keyframe;
  const auto total = timer_.Measure("map");
  AcceptKeyFrame(message);
  {
    const auto measure = timer_.Measure("map.create_points");
    for (const MapPointId id : CreatePoints(sensor_, options_, keyframe, map_))
      point_culler_.Watch(id, keyframe);
  }
  if (!more_waiting) {
    FuseWithNeighbors(keyframe);
    point_culler_.CullUnconfirmed(&*map_->Write());
    AdjustBundle(keyframe, stop);
    const auto measure = timer_.Measure("map.cull");
    CullKeyFrames(sensor_, options_, keyframe, &*map_->Write());
  }
  return {keyframe, map_->Read()->epoch()};
}

void LocalMapping::AcceptKeyFrame(const KeyFrameReady& message) {
  const auto guard = map_->Write();
  for (const PointStatistics& s : message.statistics) {
    MapPoint* point = guard->Find(guard->Resolve(s.point));
    if (point == nullptr) continue;
    point->times_visible += s.times_visible;
    point->times_found += s.times_found;
  }
  const KeyFrame* keyframe = guard->Find(message.keyframe);
  if (keyframe == nullptr) return;
  for (const MapPointId id : keyframe->points) {
    if (id.IsValid() && guard->Find(id)->created_by == message.keyframe)
      point_culler_.Watch(id, message.keyframe);
  }
  point_culler_.Cull(message.keyframe, &*guard);
}

void LocalMapping::FuseWithNeighbors(KeyFrameId keyframe) {
  const auto measure = timer_.Measure("map.fuse");
  std::vector<KeyFrameId> targets;
  std::vector<MapPointId> own, theirs;
  {
    const auto guard = map_->Read();
    if (guard->Find(keyframe) == nullptr) return;
    targets = FusionTargets(*guard, options_, keyframe);
    own = PointsOf(*guard, std::span(&keyframe, 1));
  }
  for (const KeyFrameId target : targets) FusePoints(sensor_, target, own, options_.fusion_radius_px, map_);
  theirs = PointsOf(*map_->Read(), targets);
  FusePoints(sensor_, keyframe, theirs, options_.fusion_radius_px, map_);
}

void LocalMapping::AdjustBundle(KeyFrameId keyframe, std::stop_token stop) {
  const auto measure = timer_.Measure("map.bundle");
  MapBundle bundle;
  {
    const auto guard = map_->Read();
    if (guard->Find(keyframe) == nullptr || guard->num_keyframes() < 3) return;
    const auto window = guard->Find(keyframe)->BestCovisibles(options_.max_bundle_keyframes - 1);
    std::set<KeyFrameId> moving(window.begin(), window.end());
    moving.insert(keyframe);
    bundle = GatherBundle(*guard, sensor_, moving, options_.max_bundle_fixed);
  }
  const BundleSummary summary = SolveBundle(BundleOptions(), stop, &bundle.problem);
  ApplyBundle(bundle, summary, &*map_->Write());
}

}  // namespace orbslam
