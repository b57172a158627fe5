// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "free_space.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "working_frame.h"

namespace orbslam {

/// Of references of some age, and under a narrow gate.
SightingRules RootedRules(const WholeThingOptions& options);

/// Cells (non-zero) that these saw just where they are now, and hardly any saw through: far longer and more
/// exactly than somebody who sways holds still.
cv::Mat1b RootedCells(const Sightings& sightings);

/// Things move as wholes: whose hands move while his back seems to rest is about to move his back. A thing is
/// what hangs together once furniture, which is flat, and what is rooted are taken away, as a table is from
/// what stands on it (Rusu et al., Robotics and Autonomous Systems 2008). The cells (non-zero) of those
/// things of which a good part moves, as far as they are within reach of that part; what moves already is not
/// among them.
cv::Mat1b WholeThings(const GridCamera& camera, const WorkingFrame& frame, const cv::Mat1b& moving,
                      const cv::Mat1b& rooted, const WholeThingOptions& options);

}  // namespace orbslam
