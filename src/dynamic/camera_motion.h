// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "far_motion.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "scene_history.h"
#include "tracked_corner.h"

namespace orbslam {

/// How the camera moved from the last frame to this one. Colour and depth images are taken at different times
/// (up to 15 ms apart): each has a motion of its own.
struct CameraMotion {
  Rigid3d color_current_from_previous, depth_current_from_previous;
  std::vector<TrackedCorner> corners;
  int num_inliers = 0;
  double fit_share = 0;
  bool is_depth_misled = false;  // the depth's own alignment was not believed
  std::string failure;           // why it is not to be trusted; empty: it is
};

/// Corners of an older frame, where they are now; and how the camera moved between the two colour images,
/// which is found from them: from one frame to the next, somebody who sets off fits together with the room,
/// but over half a second he parts from it.
struct OlderCorners {
  std::vector<TrackedCorner> corners;  // none, if the motion could not be found
  std::optional<Rigid3d> current_from_older;
  std::optional<FarMotion> far;  // by which it was found: what is carried had followed something near
};

class CameraMotionEstimator {
 public:
  CameraMotionEstimator(const WorkingGrids& grids, const CameraMotionOptions& options)
      : grids_(grids), options_(options), inlier_px_(options.pose.inlier_px) {}

  /// seed: of the random draws, for example the frame's id.
  CameraMotion Estimate(const SceneHistory& history, const WorkingFrame& current, uint64_t seed);
  /// last: the frame before this one, whose mask is newer. seed: as above.
  OlderCorners FollowFrom(const ReferenceView& older, const ReferenceView& last, const WorkingFrame& current,
                          uint64_t seed) const;
  /// Once something near turned out to be followed: the motion since the last frame, by what is farther than
  /// split_m. As it was, if that does not tell.
  void FollowFar(const ReferenceView& last, const WorkingFrame& current, double split_m, uint64_t seed,
                 CameraMotion* motion);
  void Reset() { velocity_ = {}, previous_interval_s_ = 0, inlier_px_ = options_.pose.inlier_px; }

 private:
  Rigid3d Predict(double interval_s) const;
  PoseFromCorners PoseOf(std::span<const TrackedCorner> corners, const Rigid3d& predicted,
                         uint64_t seed) const;
  PoseFromCorners PoseOfFew(std::span<const TrackedCorner> corners, const Rigid3d& depth_motion,
                            uint64_t seed) const;
  std::optional<FarMotion> FarMotionSince(const ReferenceView& older, const WorkingFrame& current,
                                          std::span<const CornerMatch> matches, uint64_t seed) const;
  PoseFromCorners PoseSince(const ReferenceView& older, const std::vector<CornerMatch>& matches,
                            uint64_t seed) const;

  WorkingGrids grids_;
  CameraMotionOptions options_;
  Rigid3d velocity_;  // the last colour motion, over previous_interval_s_
  double previous_interval_s_ = 0;
  float inlier_px_;  // for the next frame
};

}  // namespace orbslam
