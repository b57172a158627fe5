// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "orbslam/dynamic/dynamic_detector_options.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/util/random.h"
#include "working_frame.h"

namespace orbslam {

/// A corner of the last frame that was found in this one.
struct CornerMatch {
  Eigen::Vector3f x_previous;  // metres, camera frame of the last colour image
  Eigen::Vector2f pixel;       // grey grid, in this image
};

struct PoseFromCorners {
  Rigid3d current_from_previous;
  /// Inverse covariance of small motions in the current frame: rotation (rad) before translation (m).
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  int num_inliers = 0;
  bool ok = false;
};

/// What else is known of the motion; information as above.
struct PosePrior {
  Rigid3d current_from_previous;
  Eigen::Matrix<double, 6, 6> information;
};

/// From where a match is to where it would be if it rested, given current_from_previous (grey px).
Eigen::Vector2d ErrorPx(const GridCamera& camera, const Rigid3d& pose, const CornerMatch& match);
/// Derivative of that place by small motions, as in information.
Eigen::Matrix<double, 2, 6> PixelFromMotion(const GridCamera& camera, const Rigid3d& pose,
                                            const CornerMatch& match);

/// The camera's motion from corners: RANSAC over triples, in which the candidates given (a motion model, "no
/// motion") compete; then Gauss-Newton on the inliers, and the prior, if there is one.
PoseFromCorners EstimatePose(const GridCamera& camera, const std::vector<CornerMatch>& matches,
                             const std::vector<Rigid3d>& candidates, const PoseFromCornersOptions& options,
                             Rng* rng, const PosePrior* prior = nullptr);

}  // namespace orbslam
