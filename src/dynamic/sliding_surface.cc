// SPDX-License-Identifier: GPL-3.0-or-later
#include "sliding_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace orbslam {
namespace {

bool IsNeighbor(const TrackedCorner& a, const TrackedCorner& b, const SlidingOptions& options) {
  const cv::Point2f offset = a.current - b.current;
  return b.depth_m > 0 && offset.dot(offset) < options.radius_px * options.radius_px &&
         std::abs(a.depth_m - b.depth_m) < options.depth_share * a.depth_m;
}

/// Whether most of the corners around it move, and by their mean to the same side.
bool MovesWithNeighbors(const TrackedCorner& corner, std::span<const TrackedCorner> corners, float gate_px,
                        const SlidingOptions& options) {
  constexpr float kMaxExcessPx = 10.f;  // beyond, the patch was probably confused; its direction counts
  if (corner.residual_px <= gate_px) return false;
  cv::Point2f sum;
  int count = 0, num_moving = 0;
  for (const TrackedCorner& other : corners) {
    if (!IsNeighbor(corner, other, options)) continue;
    sum += other.excess * (kMaxExcessPx / std::max(kMaxExcessPx, other.residual_px));
    ++count;
    num_moving += other.residual_px > gate_px;
  }
  return count >= options.min_neighbors && 2 * num_moving > count &&
         cv::norm(sum) > static_cast<float>(count) * gate_px;
}

}  // namespace

float MovingGatePx(std::span<const TrackedCorner> corners, const SlidingOptions& options) {
  std::vector<float> residuals;
  for (const TrackedCorner& corner : corners)
    if (corner.depth_m > 0 && !corner.was_moving) residuals.push_back(corner.residual_px);
  if (static_cast<int>(residuals.size()) < options.min_resting) return options.max_gate_px;
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return std::clamp(options.gate_medians * *middle, options.min_gate_px, options.max_gate_px);
}

cv::Mat1b SlidingCells(const cv::Mat1f& depth_m, std::span<const TrackedCorner> corners, float moving_gate_px,
                       const SlidingOptions& options) {
  cv::Mat1b sliding(depth_m.size(), uint8_t{0}), reached(depth_m.size(), uint8_t{0});
  const cv::Rect inside({0, 0}, depth_m.size());
  std::vector<cv::Point> front, next;
  for (const TrackedCorner& corner : corners) {
    const cv::Point cell(cvFloor(corner.current.x / 2), cvFloor(corner.current.y / 2));
    if (!(corner.depth_m > 0) || !inside.contains(cell) || reached(cell) != 0) continue;
    reached(cell) = 1;
    sliding(cell) = MovesWithNeighbors(corner, corners, moving_gate_px, options) ? 255 : 0;
    front.push_back(cell);
  }
  // From all corners at once: each cell follows the nearest one of its own surface.
  for (int step = 0; step < options.max_steps; ++step) {
    next.clear();
    for (const cv::Point& cell : front)
      for (const cv::Point& offset : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point neighbor = cell + offset;
        if (!inside.contains(neighbor) || reached(neighbor) != 0) continue;
        const float here = depth_m(cell), there = depth_m(neighbor);
        if (!(std::min(here, there) > 0) || std::abs(here - there) > MaxSurfaceStepM(std::min(here, there)))
          continue;
        reached(neighbor) = 1;
        sliding(neighbor) = sliding(cell);
        next.push_back(neighbor);
      }
    std::swap(front, next);
  }
  return sliding;
}

}  // namespace orbslam
