// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "orbslam/dynamic/dynamic_detector_options.h"
#include "segmenter.h"

namespace orbslam {

/// Clusters of the included cells as SegmentCells finds them, but large flat parts (a floor that comes into
/// view between the legs of someone who walks on it) are clusters of their own, and what they joined is no
/// longer joined: what is known of a walker says nothing of the floor.
Segmentation SegmentSurfaces(const GridCamera& camera, const WorkingFrame& frame, const cv::Mat1b& included,
                             const SegmentationOptions& options);

/// Of each cluster the cells on its largest plane, if that is at least min_area_m2; they are taken out of the
/// included cells.
std::vector<Cluster> TakePlanes(const GridCamera& camera, const WorkingFrame& frame,
                                std::span<const Cluster> clusters, float min_area_m2, cv::Mat1b* included);

}  // namespace orbslam
