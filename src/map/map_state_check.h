// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/map/map_state.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// Whether a map can be built of the state: every id and index refers to something, every number is finite
/// and in its range, nothing is its own ancestor. Takes time and memory in proportion to the state and
/// to num_point_ids, whatever they say.
Status CheckMapState(const MapState& state);

}  // namespace orbslam
