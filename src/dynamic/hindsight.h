// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "orbslam/dynamic/dynamic_detector_options.h"
#include "reference_view.h"

namespace orbslam {

/// Cells (non-zero) of a past view on what has gone since: the present view sees through where they were. Of
/// a thing before something without depth, nobody can see through a part: it goes with the rest.
/// past.reference_from_current: of the present view.
cv::Mat1b GoneSince(const GridCamera& camera, const ReferenceView& past, ReferenceView present,
                    const FreeSpaceOptions& free_space, const SegmentationOptions& segmentation);

}  // namespace orbslam
