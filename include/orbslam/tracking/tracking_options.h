// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

/// Thresholds of Tracking; values of ORB-SLAM2 (Mur-Artal and Tardos 2017) unless a line says otherwise.
struct TrackingOptions {
  int min_initial_depth_points =
      100;  // to start a map. ORB-SLAM2 asks for 500 keypoints; depth points are what counts
  double motion_radius_px = 10;  // search window round a prediction, px of the point's level; doubled once
  int min_motion_matches = 20;   // below: double the window, then fall back to the reference keyframe
  int min_strong_inliers = 50;   // fewer with the predicted pose: the reference keyframe is asked too
  int min_inliers = 10;          // map points after the first pose
  int min_local_inliers = 20;    // map points after the local map: below, the frame is lost. ORB-SLAM2: 30
  int min_relocalized_inliers = 30;    // the same when the camera was lost. ORB-SLAM2: 50
  double max_speed_mps = 10;           // of the camera: a pose that is farther off than that is a wrong one
  int max_local_keyframes = 40;        // ORB-SLAM2: 80
  int local_neighbors = 10;            // best covisibles taken in with each local keyframe
  double local_radius_px = 2.5;        // search window of local points seen head-on, px of their level ...
  double local_radius_oblique_px = 4;  // ... and of those seen from a new direction
  double local_radius_factor = 2;      // of both. ORB-SLAM2: 3
  double max_ratio_local = 0.8;
  double max_ratio_reference = 0.7;
  int min_unmasked_keypoints = 50;  // fewer off a mask: it is not used. What min_local_inliers needs, with a
                                    // margin for keypoints that are no map points
  double doubtful_share = 0.5;      // of the image, masked: most of what is seen then moves, and may ...
  double max_doubt_s = 1;           // ... still be there so long after, unseen by the detector
  double max_unseen_s = 1;  // who sets off is known after so long; what was seen of him until then goes
  bool doubt_near_points = false;  // leave out what is near and contradicts what is far (FarPose); for scenes
                                   // in which things move
  double min_view_cos = 0.5;       // 60 degrees from a point's mean viewing direction
  double revision_delay_s = 3;     // after which a frame's pose is looked for again; 0: never. Who set off is
                                   // known after one second, the last adjustment done after two
};

/// When a frame becomes a keyframe (ORB-SLAM2, section III-E).
struct KeyFramePolicyOptions {
  double max_interval_s = 1.0;  // at the latest, after so long ...
  // ... or if fewer are tracked of those points of the reference keyframe that another keyframe sees too, ...
  double min_tracked_ratio = 0.75;
  // ... or of all its points. Few of a new keyframe's points have a second observer yet, and were those all
  // that count, the camera would leave its points behind before it is noticed. ORB-SLAM2 asks this of its
  // first keyframe only. With 0.4 a camera before walkers follows a third of its keypoints; from
  // 0.7 on the chain of keyframes grows long, and its drift outweighs what more points gain.
  double min_tracked_ratio_all = 0.6;
  double weak_share = 1.0 / 3;   // fewer than this share of either: even if the mapper is busy
  int min_tracked_close = 100;   // fewer close points tracked ...
  int min_untracked_close = 70;  // ... while so many could be made
  int min_inliers = 15;
  int min_depth_points = 1000;  // depth points made at a keyframe, closest first, even beyond the close
                                // limit. ORB-SLAM2: 100; far ones hold the rotation where nothing is close
};

}  // namespace orbslam
