// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "orbslam/camera/stereo_intrinsics.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/util/random.h"

namespace orbslam {

/// The same thing, seen from frames a and b: where it is in each camera's frame, and the keypoint that saw
/// it.
struct RelativePoseMatch {
  Eigen::Vector3d point_a, point_b;                       // m
  Eigen::Vector2d pixel_a, pixel_b;                       // (u, v), undistorted px
  double inverse_variance_a = 1, inverse_variance_b = 1;  // 1 / px^2
};

struct RelativePoseProblem {
  StereoIntrinsics intrinsics;
  std::vector<RelativePoseMatch> matches;
};

struct RelativePoseOptions {
  double max_chi2 = 9.21;    // chi-square, 2 dof, 99 %: of each of the two reprojections
  int max_samples = 300;     // of RANSAC, fewer once confident
  double confidence = 0.99;  // to have drawn a sample of inliers
  int min_inliers = 6;       // with fewer there is no estimate
  int num_rounds = 4;        // of refinement, each followed by reclassification
  int max_iterations = 10;   // a round
};

struct RelativePoseResult {
  Rigid3d b_from_a;
  std::vector<char> is_inlier;  // one a match: a's point falls on b's pixel and b's on a's
  int num_inliers = 0;
};

/// The motion that most matches agree on: RANSAC over alignments of three points (Fischler and Bolles, CACM
/// 1981; Horn, JOSA 1987). Scale is 1, as depth observes it. Nothing without min_inliers matches that agree.
std::optional<RelativePoseResult> EstimateRelativePose(const RelativePoseProblem& problem,
                                                       const RelativePoseOptions& options, Rng* rng);

/// The motion that minimises the Huber-weighted reprojection error of a's points in b and of b's in a, in
/// rounds with reclassification; the last round has no robust loss. (ORB-SLAM, Mur-Artal, Montiel and Tardos
/// 2015, appendix "relative Sim(3) optimization", without scale.) With fewer than 3 usable matches the prior
/// is returned and nothing is an inlier.
RelativePoseResult RefineRelativePose(const RelativePoseProblem& problem, const Rigid3d& b_from_a,
                                      const RelativePoseOptions& options = {});

}  // namespace orbslam
