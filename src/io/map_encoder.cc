// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <span>
#include <vector>

#include "map_codec.h"
#include "orbslam/util/bytes.h"

namespace orbslam {
namespace {

template <class T>
void Append(const std::vector<T>& items, std::string* bytes) {
  AppendBytes(std::span<const T>(items), bytes);
}

template <class T>
void AppendOne(const T& item, std::string* bytes) {
  AppendBytes(std::span<const T>(&item, 1), bytes);
}

uint32_t Count(const auto& items) { return static_cast<uint32_t>(items.size()); }

PoseRecord ToRecord(const Rigid3d& b_from_a) {
  const auto& [q, t] = b_from_a;
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

KeyFrameRecord ToRecord(const KeyFrame& keyframe) {
  const ImageBounds& bounds = keyframe.features->grid.bounds();
  return {.id = keyframe.id.value,
          .frame_id = keyframe.frame_id.value,
          .parent = keyframe.parent.value,
          .num_keypoints = Count(keyframe.features->pixels),
          .timestamp_s = keyframe.timestamp_s,
          .camera_from_world = ToRecord(keyframe.camera_from_world),
          .bounds = {bounds.min_u, bounds.min_v, bounds.max_u, bounds.max_v}};
}

PointRecord ToRecord(const MapPoint& point) {
  PointRecord record{.min_distance_m = point.min_distance_m,
                     .max_distance_m = point.max_distance_m,
                     .descriptor = point.descriptor.words,
                     .id = point.id.value,
                     .created_by = point.created_by.value,
                     .times_visible = point.times_visible,
                     .times_found = point.times_found};
  std::ranges::copy(point.position_world, record.position_world.begin());
  std::ranges::copy(point.normal_world, record.normal_world.begin());
  return record;
}

void AppendKeyFrame(const KeyFrame& keyframe, std::string* bytes) {
  const FrameFeatures& features = *keyframe.features;
  AppendOne(ToRecord(keyframe), bytes);
  Append(features.pixels, bytes);
  Append(features.angles_deg, bytes);
  Append(std::vector<uint8_t>(features.levels.begin(), features.levels.end()), bytes);
  Append(features.descriptors, bytes);
  Append(features.depths_m, bytes);
  Append(features.right_u, bytes);
  Append(keyframe.points, bytes);
}

std::string FormatBody(const MapState& state) {
  std::string bytes;
  for (const KeyFrame& keyframe : state.keyframes) AppendKeyFrame(keyframe, &bytes);
  for (const auto& [id, remains] : state.remains) {
    AppendOne(RemainsRecord{id.value, remains.parent.value, ToRecord(remains.self_from_parent)}, &bytes);
  }
  for (const auto& [older, newer] : state.loop_edges) {
    AppendOne(LoopEdgeRecord{older.value, newer.value}, &bytes);
  }
  for (const MapPoint& point : state.points) AppendOne(ToRecord(point), &bytes);
  std::vector<MapPointId> fused_into(state.num_point_ids);
  for (const auto& [from, into] : state.fused_into) fused_into[from.value] = into;
  Append(fused_into, &bytes);
  return bytes;
}

}  // namespace

uint64_t MapChecksum(MapHeader header, std::string_view body) {
  header.checksum = 0;
  return MixChecksum(Checksum(std::as_bytes(std::span(&header, 1))),
                     Checksum(std::as_bytes(std::span(body))));
}

std::string FormatMap(const MapState& state) {
  const std::string body = FormatBody(state);
  MapHeader header{.version = kMapVersion,
                   .num_levels = static_cast<uint32_t>(state.pyramid.num_levels()),
                   .scale_factor = state.pyramid.factor(),
                   .epoch = state.epoch,
                   .num_keyframes = Count(state.keyframes),
                   .num_remains = Count(state.remains),
                   .num_loop_edges = Count(state.loop_edges),
                   .num_points = Count(state.points),
                   .num_point_ids = state.num_point_ids,
                   .num_bytes = sizeof(MapHeader) + body.size()};
  kMapMagic.copy(header.magic.data(), header.magic.size());
  header.checksum = MapChecksum(header, body);
  std::string bytes;
  bytes.reserve(header.num_bytes);
  AppendOne(header, &bytes);
  return bytes += body;
}

}  // namespace orbslam
