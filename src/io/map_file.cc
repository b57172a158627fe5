// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/map_file.h"

#include <utility>

#include "map_codec.h"
#include "orbslam/util/file.h"

namespace orbslam {
namespace {

constexpr size_t kMaxBytes = size_t{1} << 31;  // 37000 keyframes of 1000 keypoints

Error In(const std::string& path, const std::string& what) { return Error{path + ": " + what}; }

}  // namespace

Status WriteMap(const std::string& path, const MapData& map) {
  const std::string bytes = FormatMap(map.Export());
  if (bytes.size() > kMaxBytes) return In(path, "cannot write: the map is larger than 2 GiB");
  return WriteFileAtomically(path, bytes);
}

Result<MapData> ReadMap(const std::string& path) {
  Result<std::string> file = ReadFile(path, kMaxBytes);
  if (!file) return file.error();
  Result<MapState> state = ParseMap(*file);
  if (!state) return In(path, state.error().message);
  Result<MapData> map = MapData::FromState(*std::move(state));
  if (!map) return In(path, "damaged map: " + map.error().message);
  return map;
}

}  // namespace orbslam
