// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_gate.h"

#include <algorithm>

namespace orbslam {

CornerGate MakeCornerGate(std::span<const TrackedCorner> corners, const CornerGateOptions& options) {
  std::vector<float> residuals;
  for (const TrackedCorner& corner : corners)
    if (corner.depth_m > 0 && !corner.was_moving) residuals.push_back(corner.residual_px);
  float moving_px = options.max_px;
  if (static_cast<int>(residuals.size()) >= options.min_resting) {
    const auto rank = static_cast<std::ptrdiff_t>(options.quantile * static_cast<double>(residuals.size()));
    std::nth_element(residuals.begin(), residuals.begin() + rank, residuals.end());
    moving_px = std::clamp(options.multiple * residuals[rank], options.min_px, options.max_px);
  }
  return {moving_px, std::min(1.f, options.max_sharp_px / moving_px)};
}

}  // namespace orbslam
