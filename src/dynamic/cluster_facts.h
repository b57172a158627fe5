// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "corner_gate.h"
#include "free_space.h"
#include "segmenter.h"

namespace orbslam {

/// What is known of a cluster.
struct ClusterFacts {
  int num_cells = 0;
  int num_judged = 0;      // cells of which some reference can say something
  int num_suspicious = 0;  // cells in space that was seen empty
  int num_border = 0;      // cells with a neighbour outside the cluster
  int num_interior = 0;    // cells whose 8 neighbours belong to the cluster too
  int num_attached = 0;    // border cells next to a confirmed static cell of the same surface
  float carried = 0;       // mean log-odds carried over from the last frame
  float sharpness = 1;     // of the picture, CornerGate's
  int num_corners = 0, num_moving_corners = 0;  // followed; not where a static point would be
};

/// Large flat clusters are judged by the space they are in alone: a floor that comes into view between the
/// feet of a walker has neither moved before, nor by the corners of his shoes. flows: from the last frame,
/// and others. Of one of these that is not sharp, only what moves counts, and only on what moved before.
std::vector<ClusterFacts> GatherFacts(const Segmentation& segmentation, const WorkingFrame& frame,
                                      const FreeSpaceVotes& votes, const cv::Mat1f& carried,
                                      std::span<const Flow> flows);

}  // namespace orbslam
