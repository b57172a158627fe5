// SPDX-License-Identifier: GPL-3.0-or-later
#include "sliding_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cells.h"

namespace orbslam {
namespace {

constexpr uint8_t kUnreached = 0, kResting = 1, kSliding = 2;

bool IsNeighbor(const TrackedCorner& a, const TrackedCorner& b, const SlidingOptions& options) {
  const cv::Point2f offset = a.current - b.current;
  return (b.depth_m > 0) &
         (offset.x * offset.x + offset.y * offset.y < options.radius_px * options.radius_px) &
         (std::abs(a.depth_m - b.depth_m) < options.depth_share * a.depth_m);
}

/// Whether most of the corners around it move, and alike.
bool MovesWithNeighbors(const TrackedCorner& corner, const Flow& flow, const SlidingOptions& options) {
  if (!flow.Moves(corner)) return false;
  cv::Point2f sum;
  float sum_of_lengths = 0;
  int count = 0, num_moving = 0;
  for (const TrackedCorner& other : flow.corners) {
    if (!IsNeighbor(corner, other, options)) continue;
    sum += other.excess;
    sum_of_lengths += other.residual_px;
    ++count;
    num_moving += flow.Moves(other);
  }
  return count >= options.min_neighbors && 2 * num_moving > count &&
         cv::norm(sum) > options.min_likeness * sum_of_lengths;
}

}  // namespace

cv::Mat1b SlidingCells(const cv::Mat1f& depth_m, const Flow& flow, const SlidingOptions& options) {
  const cv::Rect inside({1, 1}, depth_m.size());
  cv::Mat1f framed_m;  // by cells without depth, at which every step ends
  cv::copyMakeBorder(depth_m, framed_m, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat1b state(framed_m.size(), kUnreached);
  std::vector<int> front, next;
  bool any_slides = false;
  for (const TrackedCorner& corner : flow.corners) {
    const cv::Point cell = CellOf(corner) + inside.tl();
    if (!(corner.depth_m > 0) || !inside.contains(cell) || state(cell) != kUnreached) continue;
    const bool is_sliding = MovesWithNeighbors(corner, flow, options);
    any_slides = any_slides || is_sliding;
    state(cell) = is_sliding ? kSliding : kResting;
    front.push_back(cell.y * state.cols + cell.x);
  }
  if (!any_slides) return cv::Mat1b(depth_m.size(), uint8_t{0});
  // From all corners at once: each cell follows the nearest one of its own surface.
  const auto z_m = Cells(framed_m);
  const auto states = Cells(state);
  for (int step = 0; step < options.max_steps; ++step) {
    next.clear();
    for (const int cell : front)
      for (const int neighbor : {cell + 1, cell - 1, cell + state.cols, cell - state.cols}) {
        if (states[neighbor] != kUnreached) continue;
        const float nearer_m = std::min(z_m[cell], z_m[neighbor]);
        if (!(nearer_m > 0) || std::abs(z_m[cell] - z_m[neighbor]) > MaxSurfaceStepM(nearer_m)) continue;
        states[neighbor] = states[cell];
        next.push_back(neighbor);
      }
    std::swap(front, next);
  }
  cv::Mat1b sliding;
  cv::compare(state(inside), kSliding, sliding, cv::CMP_EQ);
  return sliding;
}

}  // namespace orbslam
