// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace orbslam {

/// The depth between near and far: that which parts the depths' logarithms into the two groups whose means
/// differ most (Otsu, IEEE SMC 1979). Depths in metres, > 0; 0 if all are alike.
double SplitDepthM(const std::vector<double>& depths_m);

}  // namespace orbslam
