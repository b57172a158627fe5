// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "orbslam/loop/loop_options.h"
#include "orbslam/loop/loop_verifier.h"
#include "orbslam/map/map.h"
#include "orbslam/pipeline/edit_turn.h"
#include "orbslam/pipeline/past_frame.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Closes a verified loop: the current keyframe's surroundings move to where the old place puts them, the
/// essential graph spreads the drift over all that lies between, and points that turn out to be the same are
/// fused. Takes the turn and the map's guards itself. False: a keyframe is gone, or the optimisation failed;
/// the map is unchanged. (ORB-SLAM, sections VII-C and VII-D.)
bool CloseLoop(const LoopOptions& options, const Sensor& sensor, const Loop& loop, EditTurn* turn, Map* map);

/// Bundle adjustment of the whole map, applied in one step also to what was mapped meanwhile. False: stopped,
/// discarded because the map was corrected meanwhile, or a numerical failure; the map is unchanged.
/// others: frames that have seen the map too; many of them make its points exact.
bool AdjustGlobally(const LoopOptions& options, const Sensor& sensor,
                    std::span<const PastFrame* const> others, std::stop_token stop, EditTurn* turn, Map* map);

}  // namespace orbslam
