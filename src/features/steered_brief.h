// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "orbslam/features/descriptor.h"

namespace orbslam {

/// Distance from a pixel that its rotated pattern, read four bytes at a time, stays within, px.
constexpr int kPatternReach = 19;

/// Steered BRIEF (Rublee et al., "ORB", ICCV 2011, section 4) of a pixel of a smoothed image whose rows are
/// `step` bytes apart: the same bits as OpenCV's for the same angle.
Descriptor DescribePixel(const uint8_t* pixel, ptrdiff_t step, float angle_deg);

}  // namespace orbslam
