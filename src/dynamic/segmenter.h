// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "working_frame.h"

namespace orbslam {

/// A connected surface of the organised cloud.
struct Cluster {
  std::vector<int> cells;  // indices into the grid, ascending
  bool is_flat = false;    // and large: a floor, a wall, a table
};

struct Segmentation {
  cv::Mat1i labels;  // cells: index of the cluster, -1: none
  std::vector<Cluster> clusters;
};

/// Connected components (PCL's organised segmentation, Trevor et al., SPME 2013) of the cells that have depth
/// and are included (non-zero); neighbours are linked whose depth differs by less than a surface's step.
Segmentation SegmentCells(const cv::Mat1f& depth_m, const cv::Mat1b& included, int min_cells);

/// Of the same components those that hold one of the seeds (non-zero), by their first cells: what is far from
/// any seed is not looked at.
std::vector<Cluster> SeededClusters(const cv::Mat1f& depth_m, const cv::Mat1b& included,
                                    const cv::Mat1b& seeds, int min_cells);

}  // namespace orbslam
