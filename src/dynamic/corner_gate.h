// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "camera_motion.h"

namespace orbslam {

/// From which residual on a corner moves: as sensitive as this frame's flow and camera motion are exact.
struct CornerGate {
  float moving_px = 0;  // grey px
  float sharpness = 1;  // 1 in a sharp picture; below, as many times less exact

  bool IsSharp() const { return sharpness >= 1; }
};
CornerGate MakeCornerGate(std::span<const TrackedCorner> corners, const CornerGateOptions& options);

/// Corners that were followed from one and the same frame, and what of them to call a motion.
struct Flow {
  std::vector<TrackedCorner> corners;
  CornerGate gate;
  bool far_alone_rests = false;  // by that the camera's motion was found: near ones contradict it

  bool Moves(const TrackedCorner& corner) const { return corner.residual_px > gate.moving_px; }
};
inline Flow MakeFlow(std::vector<TrackedCorner> corners, const CornerGateOptions& options) {
  const CornerGate gate = MakeCornerGate(corners, options);
  return {std::move(corners), gate, false};
}

}  // namespace orbslam
