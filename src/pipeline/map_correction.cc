// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/map_correction.h"

#include <vector>

namespace orbslam {
namespace {

/// Where every keyframe is to go. Chains up to the next estimated ancestor are resolved without recursion,
/// since a spanning tree may be a thousand keyframes deep.
std::map<KeyFrameId, Rigid3d> ExtendToAll(const std::map<KeyFrameId, Rigid3d>& estimated,
                                          const MapData& map) {
  std::map<KeyFrameId, Rigid3d> all;
  for (const KeyFrame& keyframe : map.KeyFrames()) {
    std::vector<const KeyFrame*> chain;
    const KeyFrame* ancestor = &keyframe;
    while (!all.contains(ancestor->id) && !estimated.contains(ancestor->id) && ancestor->parent.IsValid()) {
      chain.push_back(ancestor);
      ancestor = map.Find(ancestor->parent);
    }
    if (!all.contains(ancestor->id)) {
      const auto own = estimated.find(ancestor->id);
      all[ancestor->id] = own != estimated.end() ? own->second : ancestor->camera_from_world;
    }
    for (; !chain.empty(); chain.pop_back()) {
      const KeyFrame& child = *chain.back();
      const Rigid3d child_from_parent =
          child.camera_from_world * Inverse(map.Find(child.parent)->camera_from_world);
      all[child.id] = child_from_parent * all.at(child.parent);
    }
  }
  return all;
}

}  // namespace

void CorrectMap(const MapCorrection& correction, MapData* map) {
  const std::map<KeyFrameId, Rigid3d> new_poses = ExtendToAll(correction.camera_from_world, *map);
  for (MapPoint& point : map->MutableMapPoints()) {
    const auto own = correction.position_world.find(point.id);
    if (own != correction.position_world.end()) {
      point.position_world = own->second;
    } else {
      const KeyFrameId first = point.observations.front().keyframe;
      point.position_world =
          Inverse(new_poses.at(first)) * (map->Find(first)->camera_from_world * point.position_world);
    }
  }
  for (KeyFrame& keyframe : map->MutableKeyFrames()) keyframe.camera_from_world = new_poses.at(keyframe.id);
  for (const MapPoint& point : map->MapPoints()) map->RefreshMapPoint(point.id);
  map->BumpEpoch();
}

}  // namespace orbslam
