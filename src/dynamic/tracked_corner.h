// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corner_flow.h"
#include "ego_motion.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "reference_view.h"

namespace orbslam {

/// A corner followed from an earlier frame, mostly the last one, into this one.
struct TrackedCorner {
  cv::Point2f previous, current;  // grey grid, px
  float depth_m = 0;              // in the earlier frame; 0: none
  float nearest_m = 0;            // it is between these two, which are alike
  float farthest_m = 0;           // unless it has no depth, or is at an edge of it
  bool was_moving = false;        // in the earlier frame's mask, or in the last one's
  cv::Point2f excess;             // grey px: from there (below) to where it is
  float residual_px = 0;  // length of excess: distance to the nearest of the places where a static point
                          // between those depths would be now

  bool IsDepthKnown() const { return depth_m > 0 && nearest_m == farthest_m; }
  bool IsResting() const { return IsDepthKnown() && !was_moving; }
};

/// The cell in which it is now; may lie outside the grid.
inline cv::Point CellOf(const TrackedCorner& corner) {
  return {cvFloor(corner.current.x / 2), cvFloor(corner.current.y / 2)};
}

/// Over a long one patches have turned and grown with the camera's motion, and a corner at an edge of depth
/// is elsewhere if it belongs to the other side; from the last frame to this one neither is worth its time.
enum class Baseline { kShort, kLong };

/// The corners of an earlier frame that are found in this one; motion: how the camera moved in between, as
/// far as is known. Without residuals yet.
std::vector<TrackedCorner> FollowCorners(const WorkingGrids& grids, const ReferenceView& earlier,
                                         const WorkingFrame& current, const Rigid3d& motion,
                                         Baseline baseline, const FlowOptions& options);

/// Fills in excess and residual, given the camera's motion.
void MeasureExcess(const GridCamera& gray_camera, const Rigid3d& current_from_previous,
                   std::vector<TrackedCorner>* corners);

/// Those that tell of the camera's motion.
std::vector<CornerMatch> RestingMatches(const GridCamera& gray_camera,
                                        std::span<const TrackedCorner> corners);

/// That quantile of the residuals of the resting corners; empty if they are fewer than that.
std::optional<float> RestingResidualPx(std::span<const TrackedCorner> corners, double quantile,
                                       int min_corners);

}  // namespace orbslam
