// SPDX-License-Identifier: GPL-3.0-or-later
#include "cluster_facts.h"

#include <cmath>

#include "cells.h"

namespace orbslam {
namespace {

/// What is looked at around each cell.
struct Surroundings {
  int width, height;
  std::span<const int> labels;
  std::span<const uint8_t> num_free, num_static, suspicious, confirmed_static;
  std::span<const float> depth_m;

  Surroundings(const Segmentation& segmentation, const WorkingFrame& frame, const FreeSpaceVotes& votes)
      : width(frame.depth_m.cols),
        height(frame.depth_m.rows),
        labels(Cells(segmentation.labels)),
        num_free(Cells(votes.num_free)),
        num_static(Cells(votes.num_static)),
        suspicious(Cells(votes.suspicious)),
        confirmed_static(Cells(votes.confirmed_static)),
        depth_m(Cells(frame.depth_m)) {}

  void AddCell(int cell, ClusterFacts* facts) const {
    facts->num_judged += num_free[cell] + num_static[cell] > 0;
    facts->num_suspicious += suspicious[cell] != 0;
    const int u = cell % width, v = cell / width, label = labels[cell];
    const bool left = u > 0, right = u + 1 < width, above = v > 0, below = v + 1 < height;
    const float step = MaxSurfaceStepM(depth_m[cell]);
    bool border = false, attached = false;
    const auto look = [&](bool exists, int other) {
      if (!exists || labels[other] == label) return;
      border = true;
      attached =
          attached || (confirmed_static[other] != 0 && std::abs(depth_m[other] - depth_m[cell]) < step);
    };
    look(right, cell + 1), look(left, cell - 1), look(below, cell + width), look(above, cell - width);
    facts->num_border += border;
    facts->num_attached += attached;
    facts->num_interior += !border && left && right && above && below && labels[cell - width - 1] == label &&
                           labels[cell - width + 1] == label && labels[cell + width - 1] == label &&
                           labels[cell + width + 1] == label;
  }
};

/// held: where positive a corner counts, if it moves; null: all count everywhere.
void AddCorners(const Segmentation& segmentation, const Flow& flow, const cv::Mat1f* held,
                std::vector<ClusterFacts>* all) {
  for (const TrackedCorner& corner : flow.corners) {
    const cv::Point cell = CellOf(corner);
    if (!cv::Rect({0, 0}, segmentation.labels.size()).contains(cell)) continue;
    if (held != nullptr && ((*held)(cell) <= 0 || !flow.Moves(corner))) continue;
    const int label = segmentation.labels(cell);
    if (label < 0 || segmentation.clusters[label].is_flat) continue;
    ++(*all)[label].num_corners;
    (*all)[label].num_moving_corners += flow.Moves(corner);
  }
}

}  // namespace

std::vector<ClusterFacts> GatherFacts(const Segmentation& segmentation, const WorkingFrame& frame,
                                      const FreeSpaceVotes& votes, const cv::Mat1f& carried,
                                      std::span<const Flow> flows) {
  const Surroundings surroundings(segmentation, frame, votes);
  const auto carried_odds = Cells(carried);
  std::vector<ClusterFacts> all(segmentation.clusters.size());
  for (size_t c = 0; c < all.size(); ++c) {
    const std::vector<int>& cells = segmentation.clusters[c].cells;
    all[c].sharpness = flows.front().gate.sharpness;
    all[c].num_cells = static_cast<int>(cells.size());
    for (const int cell : cells) {
      surroundings.AddCell(cell, &all[c]);
      if (!segmentation.clusters[c].is_flat)
        all[c].carried += carried_odds[cell] / static_cast<float>(cells.size());
    }
  }
  for (const Flow& flow : flows) {
    const bool only_holds = &flow != &flows.front() && !flow.gate.IsSharp();
    AddCorners(segmentation, flow, only_holds ? &carried : nullptr, &all);
  }
  return all;
}

}  // namespace orbslam
