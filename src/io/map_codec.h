// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "orbslam/map/map_state.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// The binary format, version 1, little-endian, nothing compressed. After the header follow
///   for each keyframe: a KeyFrameRecord and, for its N keypoints, N x (float32 u, v), N x float32 angle, N x
///   uint8
///     level, N x 32 bytes of descriptor, N x float32 depth, N x float32 right u, N x uint32 id of the point;
///   the RemainsRecords, the LoopEdgeRecords and the PointRecords;
///   for each point id that was ever given: uint32 id of the point it was fused into.
/// Ids that name nothing are ffffffff. The magic holds both kinds of line end, so that a transfer "as text"
/// shows.
inline constexpr std::string_view kMapMagic{"ORBM\r\n\x1a\n", 8};
inline constexpr uint32_t kMapVersion = 1;

struct MapHeader {
  std::array<char, 8> magic;
  uint32_t version;
  uint32_t num_levels;  // of the pyramid ...
  double scale_factor;  // ... and between them
  uint64_t epoch;
  uint32_t num_keyframes, num_remains, num_loop_edges, num_points, num_point_ids;
  uint32_t zero;
  uint64_t num_bytes;  // of the whole file
  uint64_t checksum;   // of everything else
};
static_assert(sizeof(MapHeader) == 72);

using PoseRecord = std::array<double, 7>;  // quaternion x y z w, translation (m)

struct KeyFrameRecord {
  uint32_t id, frame_id, parent;
  uint32_t num_keypoints;
  double timestamp_s;
  PoseRecord camera_from_world;
  std::array<float, 4> bounds;  // of the undistorted image: least u, v, greatest u, v (px)
};
static_assert(sizeof(KeyFrameRecord) == 96);

/// Of a culled keyframe.
struct RemainsRecord {
  uint32_t id, parent;
  PoseRecord self_from_parent;
};
static_assert(sizeof(RemainsRecord) == 64);

struct LoopEdgeRecord {
  uint32_t older, newer;
};

struct PointRecord {
  std::array<double, 3> position_world, normal_world;
  double min_distance_m, max_distance_m;
  std::array<uint64_t, 4> descriptor;
  uint32_t id, created_by;
  int32_t times_visible, times_found;
};
static_assert(sizeof(PointRecord) == 112);

std::string FormatMap(const MapState& state);

/// bytes: the whole file. That the state is one is for MapData::FromState() to say. Errors do not name the
/// file.
Result<MapState> ParseMap(std::string_view bytes);

/// Of all that follows the header, and of the header without it.
uint64_t MapChecksum(MapHeader header, std::string_view body);

}  // namespace orbslam
