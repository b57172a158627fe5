// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "camera_motion.h"
#include "free_space.h"
#include "segmenter.h"

namespace orbslam {

/// What is known of a cluster, from all sources.
struct ClusterEvidence {
  int num_cells = 0;
  int num_observed = 0;     // cells that some reference can judge
  int num_suspicious = 0;   // cells in space that was seen empty
  int num_attached = 0;     // border cells whose neighbour is confirmed static and of the same surface
  int num_border = 0;       // border cells
  float carried = 0;        // mean log-odds carried over from the last frame
  int num_corners = 0, num_moving_corners = 0;  // followed; and not where a static point would be
};

std::vector<ClusterEvidence> GatherEvidence(const Segmentation& segmentation, const WorkingFrame& frame,
                                            const FreeSpaceVotes& votes, const cv::Mat1f& carried,
                                            const std::vector<TrackedCorner>& corners);

struct FusionOptions {
  bool use_free_space = true, use_carry = true, use_klt_residual = true, use_attachment = true;
  float prior = -1.5f;              // log-odds that a cluster which is not confirmed static moves
  float free_share = 0.22f;         // of suspicious among observed cells: no evidence either way
  float free_gain = 10.f;           // log-odds a unit of that share
  float min_observed_share = 0.15f; // of a cluster that must be judged for its share to count in full
  float carry_gain = 0.6f;          // of the carried log-odds
  float corner_gain = 0.5f;         // log-odds a corner that moves, and a fifth of it against, one that does not
  float max_corner = 1.5f;          // bound of the corners' part
  float attachment_gain = 3.f;      // log-odds against, of a border wholly attached to static surfaces
  float free_attachment = 0.4f;     // share of the border attached that is no evidence
};

/// Log-odds that a cluster moves.
float ClusterLogOdds(const ClusterEvidence& evidence, const FusionOptions& options);

}  // namespace orbslam
