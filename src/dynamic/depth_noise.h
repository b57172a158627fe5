// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

/// DepthModel::SigmaM for inner loops: standard deviation, metres, of a depth in metres (Nguyen, Izadi and
/// Lovell 2012).
inline float DepthSigmaM(float depth_m) { return 0.0012f + 0.0019f * (depth_m - 0.4f) * (depth_m - 0.4f); }

}  // namespace orbslam
