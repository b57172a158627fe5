// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace orbslam {

/// Radius of the round patch that gives a keypoint its orientation, px. One more column is read on the right.
constexpr int kPatchRadius = 15;

/// Direction, degrees in [0, 360), from a pixel to the intensity centroid of the patch around it (Rosin 1999;
/// Rublee et al., "ORB", ICCV 2011, section 3.2). Rows are `step` bytes apart. OpenCV's patch and arc
/// tangent.
float CentroidAngleDeg(const uint8_t* pixel, ptrdiff_t step);

}  // namespace orbslam
