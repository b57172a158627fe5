// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orbslam/map/map_data.h"

namespace orbslam {

/// What is wrong with the map's cross references, a sentence each; empty: nothing. Checked are: observations
/// are mutual and sorted, a keyframe sees a point at most once, every point is seen, covisibility equals the
/// recounted number of shared points, parents and children agree and form one tree, loop edges are mutual.
std::vector<std::string> FindBrokenInvariants(const MapData& map);

}  // namespace orbslam
