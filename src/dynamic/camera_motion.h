// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corner_flow.h"
#include "ego_motion.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "scene_history.h"

namespace orbslam {

/// A corner followed from an earlier frame, mostly the last one, into this one.
struct TrackedCorner {
  cv::Point2f previous, current;  // grey grid, px
  float depth_m = 0;              // in the earlier frame; 0: none
  bool was_moving = false;        // in the earlier frame's mask
  cv::Point2f excess;             // grey px: from there (below) to where it is
  float residual_px = 0;  // length of excess: distance to where a static point would be now; without depth,
                          // to the nearest of all places where one at any depth from 0.3 m on would be
};

/// The cell in which it is now; may lie outside the grid.
inline cv::Point CellOf(const TrackedCorner& corner) {
  return {cvFloor(corner.current.x / 2), cvFloor(corner.current.y / 2)};
}

/// That quantile of the residuals of the corners that have depth and rested; empty if they are fewer than
/// that.
std::optional<float> RestingResidualPx(std::span<const TrackedCorner> corners, double quantile,
                                       int min_corners);

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

class CameraMotionEstimator {
 public:
  CameraMotionEstimator(const WorkingGrids& grids, const CameraMotionOptions& options)
      : grids_(grids), options_(options), inlier_px_(options.pose.inlier_px) {}

  /// seed: of the random draws, for example the frame's id.
  CameraMotion Estimate(const SceneHistory& history, const WorkingFrame& current, uint64_t seed);
  /// Corners of an older frame that is aligned with this one, where they are now. The camera's motion between
  /// the two colour images is refined from them; empty if it cannot be.
  std::vector<TrackedCorner> FollowFrom(const ReferenceView& reference, const WorkingFrame& current) const;
  void Reset() { velocity_ = {}, previous_interval_s_ = 0, inlier_px_ = options_.pose.inlier_px; }

 private:
  std::vector<TrackedCorner> Follow(const ReferenceView& previous, const WorkingFrame& current,
                                    const Rigid3d& predicted) const;
  Rigid3d Predict(double interval_s) const;
  PoseFromCorners PoseOf(std::span<const TrackedCorner> corners, const Rigid3d& predicted,
                         uint64_t seed) const;

  WorkingGrids grids_;
  CameraMotionOptions options_;
  Rigid3d velocity_;  // the last colour motion, over previous_interval_s_
  double previous_interval_s_ = 0;
  float inlier_px_;  // for the next frame
};

}  // namespace orbslam
