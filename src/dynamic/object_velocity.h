// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "cluster_judge.h"
#include "object_tracker.h"

namespace orbslam {

/// Gives each object the velocity, and the line integral, of the largest of its moving clusters that has one;
/// the histogram is asked for no others. log_odds: of each cell. corners: in the present frame.
void SetVelocities(const Segmentation& segmentation, std::span<const ClusterVerdict> verdicts,
                   const cv::Mat1f& log_odds, const HistogramWindow& window,
                   std::span<const TrackedCorner> corners, ObjectTracker::Labelled* labelled);

}  // namespace orbslam
