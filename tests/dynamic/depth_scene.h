// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>

#include "normals.h"
#include "working_frame.h"

namespace orbslam::test {

constexpr GridCamera kCellCamera{.width = 160, .height = 120, .fx = 130, .fy = 130, .cx = 79.5f, .cy = 59.5f};

/// Depth of what a cell's ray, with z = 1, meets; 0: nothing.
using DepthScene = std::function<float(float x, float y)>;

inline WorkingFrame See(const DepthScene& scene) {
  WorkingFrame frame;
  frame.depth_m = cv::Mat1f(kCellCamera.height, kCellCamera.width);
  for (int v = 0; v < kCellCamera.height; ++v)
    for (int u = 0; u < kCellCamera.width; ++u)
      frame.depth_m(v, u) = scene((static_cast<float>(u) - kCellCamera.cx) / kCellCamera.fx,
                                  (static_cast<float>(v) - kCellCamera.cy) / kCellCamera.fy);
  ComputeNormals(kCellCamera, &frame);
  return frame;
}

/// A camera 1 m above a floor looks down by 45 degrees; the floor ends 3 m away.
inline float Floor(float y) {
  const float z = std::sqrt(2.f) / (1 + y);
  return z > 0 && z < 3 ? z : 0;
}

/// An upright post of that radius, standing on it 1.2 m away.
inline float PostOnFloor(float x, float y, float radius_m) {
  const float floor = Floor(y), forward = 1.2f;
  // In the floor's frame: forward and down components of the ray.
  const float f = (1 - y) / std::sqrt(2.f), a = x * x + f * f, b = f * forward;
  const float root = b * b - a * (forward * forward - radius_m * radius_m);
  if (root < 0) return floor;
  const float z = (b - std::sqrt(root)) / a;
  return floor == 0 || z < floor ? z : floor;
}

}  // namespace orbslam::test
