// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>
#include <vector>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// "Pose b, seen from pose a, should be b_from_a."
struct PoseGraphEdge {
  int a = 0, b = 0;  // indices into the graph's poses
  Rigid3d b_from_a;
  double weight = 1;
};

struct PoseGraphNode {
  Rigid3d camera_from_world;
  bool is_fixed = false;
};

struct PoseGraph {
  std::vector<PoseGraphNode> nodes;
  std::vector<PoseGraphEdge> edges;
};

struct PoseGraphOptions {
  int max_iterations = 20;
  double translation_scale_m = 0.05;  // residual 1 for this many metres ...
  double rotation_scale_rad = 0.02;   // ... or radians of disagreement
  double huber_width = 0;             // edges off by more pull linearly only; in residuals; 0: no robust loss
};

struct PoseGraphSummary {
  double initial_cost = 0, final_cost = 0;
  bool is_usable = false;  // false: numerical failure, the graph is unchanged
};

/// Essential-graph optimisation over SE(3) (scale is observed by depth), Ceres with SuiteSparse.
/// At least one node should be fixed; fixed ones keep their exact values, as do nodes without edges.
/// (Strasdat, Davison, Montiel and Konolige, ICCV 2011; ORB-SLAM 2015, section VII-D.)
PoseGraphSummary SolvePoseGraph(const PoseGraphOptions& options, std::stop_token stop, PoseGraph* graph);

}  // namespace orbslam
