// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "orbslam/map/map_data.h"
#include "orbslam/util/check.h"

namespace orbslam {

KeyFrameId MapData::AddKeyFrame(FrameId frame, double timestamp_s, const Rigid3d& camera_from_world,
                                std::shared_ptr<const FrameFeatures> features) {
  ORBSLAM_CHECK(features != nullptr);
  auto keyframe = std::make_unique<KeyFrame>();
  keyframe->id = KeyFrameId(static_cast<uint32_t>(keyframes_.size()));
  keyframe->frame_id = frame;
  keyframe->timestamp_s = timestamp_s;
  keyframe->camera_from_world = camera_from_world;
  keyframe->points.resize(features->size());
  keyframe->features = std::move(features);
  keyframes_.push_back(std::move(keyframe));
  ++num_keyframes_;
  return last_keyframe_id();
}

const KeyFrame* MapData::Find(KeyFrameId id) const {
  return id.value < keyframes_.size() ? keyframes_[id.value].get() : nullptr;
}

KeyFrame* MapData::Find(KeyFrameId id) {
  return const_cast<KeyFrame*>(static_cast<const MapData*>(this)->Find(id));
}

void MapData::ConnectToSpanningTree(KeyFrameId id, KeyFrameId fallback) {
  KeyFrame* keyframe = Find(id);
  ORBSLAM_CHECK(keyframe != nullptr && !keyframe->parent.IsValid() && keyframe->children.empty());
  const auto best = keyframe->BestCovisibles(1, 1);
  const KeyFrameId parent = best.empty() ? fallback : best.front();
  if (!parent.IsValid()) return;
  ORBSLAM_CHECK(parent != id && Find(parent) != nullptr);
  keyframe->parent = parent;
  Find(parent)->children.insert(id);
}

bool MapData::EraseKeyFrame(KeyFrameId id) {
  KeyFrame* keyframe = Find(id);
  if (keyframe == nullptr || !keyframe->parent.IsValid() || !keyframe->loop_edges.empty()) return false;
  for (const MapPointId point : std::vector<MapPointId>(keyframe->points)) {
    if (point.IsValid()) RemoveObservation(point, id);
  }
  ReparentChildren(*keyframe);
  KeyFrame* parent = Find(keyframe->parent);
  parent->children.erase(id);
  remains_[id] = {parent->id, keyframe->camera_from_world * Inverse(parent->camera_from_world)};
  keyframes_[id.value].reset();
  --num_keyframes_;
  return true;
}

void MapData::ReparentChildren(KeyFrame& keyframe) {
  // The old parent is an ancestor of every child, so that no cycle can arise from it; a covisible that
  // descends from the keyframe itself could close one.
  for (const KeyFrameId child_id : keyframe.children) {
    KeyFrame* child = Find(child_id);
    KeyFrameId new_parent = keyframe.parent;
    for (const KeyFrameId candidate : child->BestCovisibles(std::numeric_limits<int>::max(), 1)) {
      if (candidate != keyframe.id && !IsAncestor(child_id, candidate) &&
          !IsAncestor(keyframe.id, candidate)) {
        new_parent = candidate;
        break;
      }
    }
    child->parent = new_parent;
    Find(new_parent)->children.insert(child_id);
  }
  keyframe.children.clear();
}

bool MapData::IsAncestor(KeyFrameId ancestor, KeyFrameId descendant) const {
  for (KeyFrameId id = descendant; id.IsValid(); id = Find(id)->parent) {
    if (id == ancestor) return true;
  }
  return false;
}

void MapData::AddLoopEdge(KeyFrameId a, KeyFrameId b) {
  KeyFrame *first = Find(a), *second = Find(b);
  ORBSLAM_CHECK(first != nullptr && second != nullptr && a != b);
  first->loop_edges.insert(b);
  second->loop_edges.insert(a);
}

KeyFrameId MapData::Resolve(KeyFrameId id) const {
  while (id.IsValid() && Find(id) == nullptr) {
    const auto found = remains_.find(id);
    id = found == remains_.end() ? KeyFrameId() : found->second.parent;
  }
  return id;
}

std::optional<Rigid3d> MapData::CameraFromWorld(KeyFrameId id) const {
  Rigid3d self_from_ancestor;
  while (Find(id) == nullptr) {
    const auto found = remains_.find(id);
    if (found == remains_.end()) return std::nullopt;
    self_from_ancestor = self_from_ancestor * found->second.self_from_parent;
    id = found->second.parent;
  }
  return self_from_ancestor * Find(id)->camera_from_world;
}

void MapData::ChangeCovisibility(KeyFrameId a, KeyFrameId b, int delta) {
  std::vector<Covisible>& list = Find(a)->covisibles;
  const auto it = std::ranges::lower_bound(list, b, {}, &Covisible::keyframe);
  if (it == list.end() || it->keyframe != b) {
    ORBSLAM_CHECK(delta > 0);
    list.insert(it, {b, delta});
  } else if ((it->num_shared_points += delta) == 0) {
    list.erase(it);
  }
}

}  // namespace orbslam
