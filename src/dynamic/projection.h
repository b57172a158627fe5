// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "orbslam/geometry/rigid3.h"
#include "working_frame.h"

namespace orbslam {

constexpr float kNowhereM = std::numeric_limits<float>::infinity();

/// A row of cells as another view sees it: index of the cell there and depth there, metres; what it does not
/// see is at index 0 and kNowhereM, behind everything, so that loops need no branches.
struct ProjectedRow {
  explicit ProjectedRow(int width) : index(width), depth_m(width) {}
  std::vector<int> index;
  std::vector<float> depth_m;
};

/// Projects row v of a depth image (0: none) into the view at other_from_this, nearest cell.
void ProjectRow(GridCamera camera, const Rigid3d& other_from_this, int v, const float* depth_m,
                ProjectedRow* row);

}  // namespace orbslam
