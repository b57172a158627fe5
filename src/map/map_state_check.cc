// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_state_check.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace orbslam {
namespace {

constexpr uint32_t kNone = KeyFrameId::kInvalid;

std::string Name(KeyFrameId id) { return "keyframe " + std::to_string(id.value); }
std::string Name(MapPointId id) { return "point " + std::to_string(id.value); }

uint32_t NumKeyFrameIds(const MapState& state) {
  return static_cast<uint32_t>(state.keyframes.size() + state.remains.size());
}

/// Index in `items` of each id below num_ids, kNone: not among them. The ids are known to be good.
template <class Item>
std::vector<uint32_t> IndexById(const std::vector<Item>& items, uint32_t num_ids) {
  std::vector<uint32_t> index(num_ids, kNone);
  for (size_t i = 0; i < items.size(); ++i) index[items[i].id.value] = static_cast<uint32_t>(i);
  return index;
}

template <class Item>
bool AreIdsAscendingBelow(const std::vector<Item>& items, uint32_t num_ids) {
  for (size_t i = 1; i < items.size(); ++i) {
    if (items[i].id <= items[i - 1].id) return false;
  }
  return items.empty() || items.back().id.value < num_ids;
}

/// Whether from every i, following next[i], one comes to an end (kNone) and not back.
bool EveryChainEnds(std::span<const uint32_t> next) {
  std::vector<uint32_t> seen_from(next.size(), kNone);
  for (uint32_t start = 0; start < next.size(); ++start) {
    uint32_t at = start;
    for (; at != kNone && seen_from[at] == kNone; at = next[at]) seen_from[at] = start;
    if (at != kNone && seen_from[at] == start) return false;
  }
  return true;
}

bool IsRigid(const Rigid3d& motion) {
  return motion.translation.allFinite() && std::abs(motion.rotation.squaredNorm() - 1) < 1e-6;
}

Status CheckIds(const MapState& state) {
  const uint32_t num_keyframe_ids = NumKeyFrameIds(state);
  if (!AreIdsAscendingBelow(state.keyframes, num_keyframe_ids))
    return Error{"the ids of its keyframes are not in order"};
  if (!AreIdsAscendingBelow(state.points, state.num_point_ids))
    return Error{"the ids of its points are not in order"};
  const auto keyframes = IndexById(state.keyframes, num_keyframe_ids);
  for (const auto& [id, remains] : state.remains) {
    if (id.value >= num_keyframe_ids || keyframes[id.value] != kNone ||
        remains.parent.value >= num_keyframe_ids || !IsRigid(remains.self_from_parent)) {
      return Error{"the remains of " + Name(id) + " are wrong"};
    }
  }
  const auto points = IndexById(state.points, state.num_point_ids);
  for (const auto& [from, into] : state.fused_into) {
    if (from.value >= state.num_point_ids || points[from.value] != kNone ||
        into.value >= state.num_point_ids) {
      return Error{Name(from) + " was fused wrongly"};
    }
  }
  return OkStatus();
}

bool AreSound(const FrameFeatures& features, int num_levels) {
  const size_t size = features.pixels.size();
  if (features.angles_deg.size() != size || features.levels.size() != size ||
      features.descriptors.size() != size || features.depths_m.size() != size ||
      features.right_u.size() != size) {
    return false;
  }
  const auto is_finite = [](float x) { return std::isfinite(x); };
  return std::ranges::all_of(features.pixels,
                             [](const auto& p) { return std::isfinite(p.x) && std::isfinite(p.y); }) &&
         std::ranges::all_of(features.angles_deg, [](float angle) { return angle >= 0 && angle <= 360; }) &&
         std::ranges::all_of(features.levels, [&](int level) { return level >= 0 && level < num_levels; }) &&
         std::ranges::all_of(features.depths_m, is_finite) &&
         std::ranges::all_of(features.right_u, is_finite);
}

Status CheckKeyFrames(const MapState& state) {
  for (const KeyFrame& keyframe : state.keyframes) {
    if (!std::isfinite(keyframe.timestamp_s) || !IsRigid(keyframe.camera_from_world)) {
      return Error{"the time stamp or the pose of " + Name(keyframe.id) + " is wrong"};
    }
    if (keyframe.features == nullptr || !AreSound(*keyframe.features, state.pyramid.num_levels()) ||
        keyframe.points.size() != keyframe.features->pixels.size()) {
      return Error{"the features of " + Name(keyframe.id) + " are wrong"};
    }
  }
  return OkStatus();
}

Status CheckPoints(const MapState& state) {
  constexpr int kMaxCount = 1 << 30;
  const auto is_length = [](double x) { return std::isfinite(x) && x >= 0; };
  const auto is_count = [](int n) { return n >= 0 && n <= kMaxCount; };
  for (const MapPoint& point : state.points) {
    const bool is_created_by_any =
        point.created_by.value < NumKeyFrameIds(state) || !point.created_by.IsValid();
    if (!point.position_world.allFinite() || !point.normal_world.allFinite() ||
        !is_length(point.min_distance_m) || !is_length(point.max_distance_m) ||
        !is_count(point.times_visible) || !is_count(point.times_found) || !is_created_by_any) {
      return Error{Name(point.id) + " is wrong"};
    }
  }
  return OkStatus();
}

Status CheckObservations(const MapState& state) {
  const auto index = IndexById(state.points, state.num_point_ids);
  std::vector<KeyFrameId> last_seen_by(state.points.size());
  for (const KeyFrame& keyframe : state.keyframes) {
    for (const MapPointId id : keyframe.points) {
      if (!id.IsValid()) continue;
      if (id.value >= index.size() || index[id.value] == kNone) {
        return Error{Name(keyframe.id) + " sees " + Name(id) + ", which is not there"};
      }
      KeyFrameId& last = last_seen_by[index[id.value]];
      if (last == keyframe.id) return Error{Name(keyframe.id) + " sees " + Name(id) + " twice"};
      last = keyframe.id;
    }
  }
  const auto unseen = std::ranges::find(last_seen_by, KeyFrameId());
  if (unseen == last_seen_by.end()) return OkStatus();
  return Error{Name(state.points[unseen - last_seen_by.begin()].id) + " is seen by nobody"};
}

Status CheckTree(const MapState& state) {
  const auto index = IndexById(state.keyframes, NumKeyFrameIds(state));
  const auto lives = [&](KeyFrameId id) { return id.value < index.size() && index[id.value] != kNone; };
  std::vector<uint32_t> parents(index.size(), kNone);
  for (const KeyFrame& keyframe : state.keyframes) {
    if (keyframe.parent.IsValid() && !lives(keyframe.parent))
      return Error{Name(keyframe.id) + " has no parent"};
    parents[keyframe.id.value] = keyframe.parent.value;
  }
  for (const auto& [id, remains] : state.remains) parents[id.value] = remains.parent.value;
  if (!EveryChainEnds(parents)) return Error{"its spanning tree has a cycle"};
  if (std::ranges::count(parents, kNone) > 1) return Error{"its spanning tree has several roots"};
  for (const auto& [older, newer] : state.loop_edges) {
    if (!lives(older) || !lives(newer) || !(older < newer)) return Error{"a loop edge of it leads nowhere"};
  }
  return OkStatus();
}

Status CheckFusions(const MapState& state) {
  std::vector<uint32_t> next(state.num_point_ids, kNone);
  for (const auto& [from, into] : state.fused_into) next[from.value] = into.value;
  if (!EveryChainEnds(next)) return Error{"its fused points stand for each other"};
  return OkStatus();
}

}  // namespace

Status CheckMapState(const MapState& state) {
  // Each relies on those before it.
  for (const auto check :
       {CheckIds, CheckKeyFrames, CheckPoints, CheckObservations, CheckTree, CheckFusions}) {
    if (Status status = check(state); !status) return status;
  }
  return OkStatus();
}

}  // namespace orbslam
