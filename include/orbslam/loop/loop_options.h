// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

/// Thresholds of LoopClosing; values of ORB-SLAM (Mur-Artal et al. 2015, section VII) unless a line says
/// otherwise.
struct LoopOptions {
  int min_keyframes_between = 10;  // loops
  int min_consistency = 3;         // keyframes in a row that must see the same place
  int min_shared_points = 15;      // of keyframes that count as neighbours
  int min_word_matches = 20;       // matches by appearance before geometry is tried
  int min_inliers = 20;            // matches that agree with the estimated motion
  int min_total_matches = 40;      // with the points of the old place's neighbours
  double guided_radius_px = 7.5;   // px of a point's level: looking again with the estimated motion ...
  double neighbor_radius_px = 10;  // ... and for the neighbours' points
  double fusion_radius_px = 4;     // when duplicates are fused after the correction
  int min_edge_weight = 100;       // shared points that make an edge of the essential graph
  int bundle_iterations = 10;      // of global bundle adjustment, each round
};

}  // namespace orbslam
