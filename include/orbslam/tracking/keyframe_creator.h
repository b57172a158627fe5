// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "orbslam/map/map.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Puts the frame into the map as a keyframe: observations of the points it shows, then new points from depth
/// for keypoints without one: all closer than the close limit, and beyond it the closest until
/// min_depth_points in all have depth. The frame's points are brought up to date. `parent_fallback`: where it
/// hangs if it shares no points. Nothing happens if the map was corrected globally since `epoch`, in which
/// the frame's pose was found.
std::optional<KeyFrameId> CreateKeyFrame(const Sensor& sensor, int min_depth_points,
                                         KeyFrameId parent_fallback, uint64_t epoch, Frame* frame, Map* map);

}  // namespace orbslam
