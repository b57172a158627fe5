// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "orbslam/optimization/pose_optimizer.h"

namespace orbslam {

/// A pose by what is far, and by what is near and agrees with it.
struct FarPose {
  PoseResult pose;
  double split_m = 0;  // depth from which on a point is far
};

/// What is near holds a pose the firmer, with the square of its distance: ten points on somebody who passes
/// before a wall take the pose with them, and then look like inliers. So what is far is asked alone. There is
/// a contradiction, and its pose, if most of what is far agrees on one and half of the near inliers of `all`,
/// the pose by all points, are 4 sigma off it; sigma has their noise and that pose's uncertainty. Those who
/// outnumber are right: not if there are more near inliers than far ones, since then the far ones may move.
std::optional<FarPose> FindContradictingFarPose(const PoseProblem& problem, const PoseResult& all);

}  // namespace orbslam
