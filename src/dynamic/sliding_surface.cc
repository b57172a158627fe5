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
  cv::Mat1b sliding(depth_m.size(), uint8_t{0}), reached(depth_m.size(), uint8_t{0});
  const cv::Rect inside({0, 0}, depth_m.size());
  std::vector<cv::Point> front, next;
  for (const TrackedCorner& corner : flow.corners) {
    const cv::Point cell = CellOf(corner);
    if (!(corner.depth_m > 0) || !inside.contains(cell) || reached(cell) != 0) continue;
    reached(cell) = 1;
    sliding(cell) = MovesWithNeighbors(corner, flow, options) ? 255 : 0;
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
