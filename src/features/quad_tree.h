// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "orbslam/features/fast_corners.h"

namespace orbslam {

/// Chooses about `wanted` (never more than 3 above) of the corners so that they cover `area`, which holds
/// them all: a quad-tree is split, the fullest nodes of a generation first, until it has as many leaves; each
/// leaf keeps its strongest corner (Mur-Artal et al., "ORB-SLAM", 2015, section III-A asks for the
/// homogeneous distribution). Reorders `corners`.
std::vector<Corner> SpreadByQuadTree(std::span<Corner> corners, const cv::Rect& area, int wanted);

}  // namespace orbslam
