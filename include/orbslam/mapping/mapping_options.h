// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

/// Thresholds of LocalMapping; values of ORB-SLAM2 (Mur-Artal and Tardos 2017) unless a line says otherwise.
struct MappingOptions {
  double min_found_ratio = 0.25;  // young points found in fewer of the frames that should see them are erased
  int min_young_observations = 2;    // a young point must have so many by the second keyframe after its own
  int min_unmeasured_observations = 3;  // a point whose depth no keyframe measured must have so many
  int triangulation_neighbors = 10;  // covisible keyframes that new points are made with
  double min_parallax_cos = 0.9998;  // rays closer than 1.1 degrees give no point
  int fusion_neighbors = 10;         // covisible keyframes, and ...
  int fusion_second_neighbors = 5;   // ... theirs, in which duplicates are looked for
  double fusion_radius_px = 3;       // px of the point's level
  int max_bundle_keyframes = 6;      // that move in a local bundle adjustment, best covisibles first
  int max_bundle_fixed = 30;         // further keyframes that hold them in place. ORB-SLAM2: all
  double redundant_ratio = 0.9;      // a keyframe is culled when so many of its close points ...
  int redundant_observers = 3;       // ... are seen by so many others at the same or a finer scale
  bool adjust_at_end = true;         // the whole map, when a sequence ends. ORB-SLAM2: only after a loop
};

}  // namespace orbslam
