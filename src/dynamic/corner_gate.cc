// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_gate.h"

#include <algorithm>

namespace orbslam {

CornerGate MakeCornerGate(std::span<const TrackedCorner> corners, const CornerGateOptions& options) {
  const std::optional<float> resting_px = RestingResidualPx(corners, options.quantile, options.min_resting);
  const float moving_px = resting_px
                              ? std::clamp(options.multiple * *resting_px, options.min_px, options.max_px)
                              : options.max_px;
  return {moving_px, std::min(1.f, options.max_sharp_px / moving_px)};
}

}  // namespace orbslam
