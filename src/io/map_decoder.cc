// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "map_codec.h"
#include "orbslam/util/bytes.h"

namespace orbslam {
namespace {

/// A keyframe's grid takes 12 kB even where its record promises no keypoint: so many fit into memory.
constexpr uint32_t kMostKeyFrames = 1 << 17;
constexpr uint32_t kMostLevels = 255;
constexpr double kGreatestScaleFactor = 10;

Status CheckHeader(const MapHeader& header, size_t file_size) {
  if (header.version != kMapVersion) {
    return Error{"map of version " + std::to_string(header.version) + "; this program reads version " +
                 std::to_string(kMapVersion)};
  }
  if (file_size != header.num_bytes) {
    return Error{std::string(file_size < header.num_bytes ? "truncated" : "damaged") + " map: " +
                 std::to_string(file_size) + " bytes instead of " + std::to_string(header.num_bytes)};
  }
  return OkStatus();
}

Status CheckLimits(const MapHeader& header) {
  if (header.num_levels < 1 || header.num_levels > kMostLevels ||
      !(header.scale_factor >= 1 && header.scale_factor <= kGreatestScaleFactor)) {
    return Error{"damaged map: impossible image pyramid"};
  }
  if (header.num_keyframes > kMostKeyFrames) {
    return Error{"map of " + std::to_string(header.num_keyframes) + " keyframes; at most " +
                 std::to_string(kMostKeyFrames) + " are read"};
  }
  return OkStatus();
}

Rigid3d FromRecord(const PoseRecord& r) { return {{r[3], r[0], r[1], r[2]}, {r[4], r[5], r[6]}}; }

MapPoint FromRecord(const PointRecord& record) {
  MapPoint point;
  point.id = MapPointId(record.id);
  point.position_world = Eigen::Map<const Eigen::Vector3d>(record.position_world.data());
  point.normal_world = Eigen::Map<const Eigen::Vector3d>(record.normal_world.data());
  point.descriptor.words = record.descriptor;
  point.min_distance_m = record.min_distance_m;
  point.max_distance_m = record.max_distance_m;
  point.created_by = KeyFrameId(record.created_by);
  point.times_visible = record.times_visible;
  point.times_found = record.times_found;
  return point;
}

/// Each of the Take functions drops from the front of bytes what it reads; false: that is not enough.
bool TakeFeatures(const KeyFrameRecord& record, FrameFeatures* features, std::string_view* bytes) {
  const size_t count = record.num_keypoints;
  std::vector<uint8_t> levels;
  if (!TakeBytes(count, &features->pixels, bytes) || !TakeBytes(count, &features->angles_deg, bytes) ||
      !TakeBytes(count, &levels, bytes) || !TakeBytes(count, &features->descriptors, bytes) ||
      !TakeBytes(count, &features->depths_m, bytes) || !TakeBytes(count, &features->right_u, bytes)) {
    return false;
  }
  features->levels.assign(levels.begin(), levels.end());
  const auto& [min_u, min_v, max_u, max_v] = record.bounds;
  features->grid = FeatureGrid(features->pixels, {min_u, min_v, max_u, max_v});
  return true;
}

bool TakeKeyFrame(KeyFrame* keyframe, std::string_view* bytes) {
  KeyFrameRecord record;
  auto features = std::make_shared<FrameFeatures>();
  if (!TakeBytes(&record, bytes) || !TakeFeatures(record, features.get(), bytes) ||
      !TakeBytes(record.num_keypoints, &keyframe->points, bytes)) {
    return false;
  }
  keyframe->id = KeyFrameId(record.id);
  keyframe->frame_id = FrameId(record.frame_id);
  keyframe->parent = KeyFrameId(record.parent);
  keyframe->timestamp_s = record.timestamp_s;
  keyframe->camera_from_world = FromRecord(record.camera_from_world);
  keyframe->features = std::move(features);
  return true;
}

bool TakeKeyFrames(uint32_t count, std::vector<KeyFrame>* keyframes, std::string_view* bytes) {
  for (uint32_t i = 0; i < count; ++i) {
    if (!TakeKeyFrame(&keyframes->emplace_back(), bytes)) return false;
  }
  return true;
}

std::optional<MapState> TakeState(const MapHeader& header, std::string_view bytes) {
  MapState state{.pyramid = ScalePyramid(static_cast<int>(header.num_levels), header.scale_factor),
                 .epoch = header.epoch,
                 .num_point_ids = header.num_point_ids};
  std::vector<RemainsRecord> remains;
  std::vector<LoopEdgeRecord> edges;
  std::vector<PointRecord> points;
  std::vector<MapPointId> fused_into;
  if (!TakeKeyFrames(header.num_keyframes, &state.keyframes, &bytes) ||
      !TakeBytes(header.num_remains, &remains, &bytes) || !TakeBytes(header.num_loop_edges, &edges, &bytes) ||
      !TakeBytes(header.num_points, &points, &bytes) ||
      !TakeBytes(header.num_point_ids, &fused_into, &bytes) || !bytes.empty()) {
    return std::nullopt;
  }
  for (const RemainsRecord& r : remains) {
    state.remains[KeyFrameId(r.id)] = {KeyFrameId(r.parent), FromRecord(r.self_from_parent)};
  }
  for (const auto& [older, newer] : edges) state.loop_edges.emplace_back(older, newer);
  for (const PointRecord& record : points) state.points.push_back(FromRecord(record));
  for (uint32_t id = 0; id < fused_into.size(); ++id) {
    if (fused_into[id].IsValid()) state.fused_into.emplace_hint(state.fused_into.end(), id, fused_into[id]);
  }
  return state;
}

}  // namespace

Result<MapState> ParseMap(std::string_view bytes) {
  if (bytes.empty()) return Error{"not a map: the file is empty"};
  if (!bytes.starts_with(kMapMagic)) return Error{"not a map of this program"};
  const size_t file_size = bytes.size();
  MapHeader header;
  if (!TakeBytes(&header, &bytes)) return Error{"truncated map: it ends within its header"};
  if (const Status status = CheckHeader(header, file_size); !status) return status.error();
  if (MapChecksum(header, bytes) != header.checksum) return Error{"damaged map: the checksum does not match"};
  if (const Status status = CheckLimits(header); !status) return status.error();
  std::optional<MapState> state = TakeState(header, bytes);
  if (!state) return Error{"damaged map: its parts do not add up to its size"};
  return *std::move(state);
}

}  // namespace orbslam
