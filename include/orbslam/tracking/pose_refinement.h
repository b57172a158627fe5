// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/map/map.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

/// Optimises the frame's pose over the map points its keypoints show, and forgets the matches that turn out to be
/// outliers or whose point is gone. Returns the number of matches left.
int RefinePose(const Map& map, const Sensor& sensor, Frame* frame);

}  // namespace orbslam
