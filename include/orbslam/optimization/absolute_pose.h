// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orbslam/optimization/pose_optimizer.h"
#include "orbslam/util/random.h"

namespace orbslam {

struct AbsolutePoseOptions {
  double max_chi2 = 5.991;   // chi-square, 2 dof, 95 %: residual (u, v)
  int max_samples = 300;     // fewer once confident
  double confidence = 0.99;  // to have drawn a sample of inliers
  int min_inliers = 10;      // with fewer there is no estimate
};

/// Where the camera is, without a prior: RANSAC over poses from three points (P3P; Ke and Roumeliotis, CVPR
/// 2017). Depth is not used. The result is that of a minimal sample: refine it with OptimizePose. Nothing
/// without min_inliers observations that agree.
std::optional<PoseResult> EstimateAbsolutePose(const StereoIntrinsics& intrinsics,
                                               const std::vector<PoseObservation>& observations,
                                               const AbsolutePoseOptions& options, Rng* rng);

}  // namespace orbslam
