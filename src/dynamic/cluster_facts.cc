// SPDX-License-Identifier: GPL-3.0-or-later
#include "cluster_facts.h"

#include <cmath>
#include <utility>

namespace orbslam {
namespace {

bool IsInterior(const cv::Mat1i& labels, int u, int v) {
  if (u == 0 || v == 0 || u == labels.cols - 1 || v == labels.rows - 1) return false;
  const int label = labels(v, u);
  return labels(v - 1, u - 1) == label && labels(v - 1, u + 1) == label && labels(v + 1, u - 1) == label &&
         labels(v + 1, u + 1) == label;
}

void AddCell(const Segmentation& segmentation, const WorkingFrame& frame, const FreeSpaceVotes& votes,
             int cell, ClusterFacts* facts) {
  const int width = frame.depth_m.cols, height = frame.depth_m.rows;
  facts->num_judged += votes.num_free(cell) + votes.num_static(cell) > 0;
  facts->num_suspicious += votes.suspicious(cell) != 0;
  const int u = cell % width, v = cell / width, label = segmentation.labels(cell);
  const float z = frame.depth_m(cell), step = MaxSurfaceStepM(z);
  bool border = false, attached = false;
  for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const int x = u + du, y = v + dv;
    if (x < 0 || y < 0 || x >= width || y >= height || segmentation.labels(y, x) == label) continue;
    border = true;
    attached = attached || (votes.confirmed_static(y, x) != 0 && std::abs(frame.depth_m(y, x) - z) < step);
  }
  facts->num_border += border;
  facts->num_interior += !border && IsInterior(segmentation.labels, u, v);
  facts->num_attached += attached;
}

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
  std::vector<ClusterFacts> all(segmentation.clusters.size());
  for (size_t c = 0; c < all.size(); ++c) {
    const std::vector<int>& cells = segmentation.clusters[c].cells;
    all[c].sharpness = flows.front().gate.sharpness;
    all[c].num_cells = static_cast<int>(cells.size());
    for (const int cell : cells) {
      AddCell(segmentation, frame, votes, cell, &all[c]);
      if (!segmentation.clusters[c].is_flat)
        all[c].carried += carried(cell) / static_cast<float>(cells.size());
    }
  }
  for (const Flow& flow : flows) {
    const bool only_holds = &flow != &flows.front() && !flow.gate.IsSharp();
    AddCorners(segmentation, flow, only_holds ? &carried : nullptr, &all);
  }
  return all;
}

}  // namespace orbslam
