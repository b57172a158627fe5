// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "orbslam/features/frame_features.h"
#include "orbslam/features/scale_pyramid.h"
#include "orbslam/matching/projection_search.h"

namespace orbslam {

/// Matches keypoints of two frames whose relative pose is known: only those near each other's epipolar line
/// are compared. fundamental: pixel_to^T F pixel_from = 0, undistorted px. For every index in from_indices
/// the keypoint of `to`, or -1; none is used twice, and all agree on how the camera rolled.
std::vector<int> SearchByEpipolarLine(const FrameFeatures& from, std::span<const int> from_indices,
                                      const FrameFeatures& to, std::span<const int> to_indices,
                                      const Eigen::Matrix3d& fundamental, const ScalePyramid& pyramid);

}  // namespace orbslam
