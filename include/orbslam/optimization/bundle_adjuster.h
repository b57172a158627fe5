// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>
#include <vector>

#include "orbslam/camera/stereo_intrinsics.h"
#include "orbslam/geometry/rigid3.h"

namespace orbslam {

struct BundlePose {
  Rigid3d camera_from_world;
  bool is_fixed = false;
};

struct BundleObservation {
  int pose = 0, point = 0;      // indices into the problem's
  Eigen::Vector3d pixel;        // (u, v, u_right), undistorted px; u_right < 0: no depth
  double inverse_variance = 1;  // 1 / px^2
};

/// Cameras, points (world frame, m) and who sees what. Solving changes camera poses that are not fixed and
/// points.
struct BundleProblem {
  StereoIntrinsics intrinsics;
  std::vector<BundlePose> poses;
  std::vector<Eigen::Vector3d> points;
  std::vector<BundleObservation> observations;
};

struct BundleOptions {
  enum class Solver { kDenseSchur, kSparseSchur, kIterativeSchur };
  // Measured (tests/bench/optimization_bench.cc): with 15 free poses, 2500 points and 12500 observations
  // dense takes 40 ms and sparse 48; with 300 poses, 30000 points and 150000 observations dense 2.0 s and
  // sparse 1.5. With more poses yet that see the same points, the iterative one (conjugate gradients) is the
  // faster, if nearly all is consistent.
  Solver solver = Solver::kDenseSchur;
  int robust_iterations = 5;       // at most; first round: Huber loss at the chi-square gates
  int final_iterations = 10;       // at most; second round, without the outliers of the first; 0: none
  double max_chi2_mono = 5.991;    // chi-square, 2 dof, 95 %
  double max_chi2_stereo = 7.815;  // chi-square, 3 dof, 95 %
  /// The gates are in units of the noise that the errors show times this, if that is less than they were
  /// given: 99.9 % pass, for what is left out here is lost to the map.
  double gate_margin = 2.5;
  /// Median squared error of a point that many poses see, over that of the median point: above, it is not one
  /// place (it moves, or is a silhouette), and none of its observations is an inlier. 0: any is.
  double max_point_error_ratio = 0;
  /// Correlation of the errors of a point's depths, in [0, 1]: its corner lies on an edge, or the depth image
  /// is bent there, alike in many of them. Of n each then weighs 1 / (1 + (n - 1) correlation): with 1, all
  /// together tell no more than one.
  double depth_correlation = 0;
  int num_threads = 1;  // more give results that differ from run to run
};

struct BundleSummary {
  std::vector<char>
      is_inlier;  // one an observation, judged at the final estimate; also false where NearestUsableM says so
  double initial_cost = 0, final_cost = 0;  // of the first round
  int num_iterations = 0;
  bool was_stopped = false;  // asked to by the stop token; the problem then holds the best estimate so far
  bool is_usable = false;    // false: numerical failure, the problem is unchanged
};

/// Bundle adjustment in Ceres with Schur elimination of the points. Stops within one iteration when asked to.
/// Fixed poses, and points without an inlier, keep their exact values. With one thread, runs repeat bit for
/// bit.
BundleSummary SolveBundle(const BundleOptions& options, std::stop_token stop, BundleProblem* problem);

}  // namespace orbslam
