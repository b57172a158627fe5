// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "orbslam/map/map_data.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// Writes the map: keyframes with their features, points, observations, spanning tree, loop edges, and what culled
/// keyframes left behind; ids are kept. Little-endian binary with a version and a checksum, written as
/// WriteFileAtomically() does and with its errors.
Status WriteMap(const std::string& path, const MapData& map);

/// Reads it back. A missing, truncated, foreign or damaged file, or one of another version, is an Error of one line.
Result<MapData> ReadMap(const std::string& path);

}  // namespace orbslam
