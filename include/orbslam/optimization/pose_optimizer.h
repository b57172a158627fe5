// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/camera/stereo_intrinsics.h"
#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// One match of a keypoint to a map point.
struct PoseObservation {
  Eigen::Vector3d point_world;  // m
  Eigen::Vector3d pixel;        // (u, v, u_right), undistorted px; u_right < 0: the keypoint has no depth
  double inverse_variance = 1;  // 1 / px^2
};

struct PoseProblem {
  StereoIntrinsics intrinsics;
  Rigid3d camera_from_world;  // the prior
  std::vector<PoseObservation> observations;
};

struct PoseOptimizerOptions {
  int num_rounds = 4;              // of optimisation, each followed by reclassification
  int max_iterations = 10;         // a round
  double max_chi2_mono = 5.991;    // chi-square, 2 dof, 95 %: residual (u, v)
  double max_chi2_stereo = 7.815;  // chi-square, 3 dof, 95 %: residual (u, v, disparity)
};

struct PoseResult {
  Rigid3d camera_from_world;
  std::vector<char> is_inlier;  // one an observation
  int num_inliers = 0;
  /// Inverse covariance of a small motion (w, t) of the camera's frame, x_camera -> Exp(w) x_camera + t, as
  /// the inliers tell it; 1 / rad^2, 1 / m^2.
  Matrix6d information = Matrix6d::Zero();
};

/// The pose that minimises the Huber-weighted reprojection error of fixed points, by Ceres' TinySolver. After
/// each round observations beyond the chi-square gate are left out of the next (and may come back); the last
/// round has no robust loss. (ORB-SLAM2, Mur-Artal and Tardos 2017, section III-C "motion-only BA".)
/// Gates are in units of the noise that the frame shows, if that is less than it was given: a Kinect's sharp
/// pictures have a third of a pixel, and somebody who sways by two is far outside.
/// With fewer than 3 observations the prior is returned and nothing is an inlier.
PoseResult OptimizePose(const PoseProblem& problem, const PoseOptimizerOptions& options = {});

}  // namespace orbslam
