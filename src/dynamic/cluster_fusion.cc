// SPDX-License-Identifier: GPL-3.0-or-later
#include "cluster_fusion.h"

#include <algorithm>
#include <cmath>

namespace orbslam {
namespace {

constexpr float kCornerGatePx = 3.f;  // grey px: 3 sigma of flow, depth noise and the time between the images

void AddCells(const Segmentation& segmentation, const WorkingFrame& frame, const FreeSpaceVotes& votes,
              const cv::Mat1f& carried, std::vector<ClusterEvidence>* all) {
  const int width = frame.depth_m.cols, height = frame.depth_m.rows;
  for (size_t c = 0; c < segmentation.clusters.size(); ++c) {
    ClusterEvidence& evidence = (*all)[c];
    evidence.num_cells = static_cast<int>(segmentation.clusters[c].cells.size());
    for (const int cell : segmentation.clusters[c].cells) {
      evidence.num_observed += votes.num_free(cell) + votes.num_static(cell) > 0;
      evidence.num_suspicious += votes.suspicious(cell) != 0;
      evidence.carried += carried(cell);
      bool border = false, attached = false;
      const int u = cell % width, v = cell / width;
      const float z = frame.depth_m(cell), step = MaxSurfaceStepM(z);
      for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const int x = u + du, y = v + dv;
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        const int other = y * width + x;
        if (segmentation.labels(other) == static_cast<int>(c)) continue;
        border = true;
        attached = attached || (votes.confirmed_static(other) != 0 && std::abs(frame.depth_m(other) - z) < step);
      }
      evidence.num_border += border;
      evidence.num_attached += attached;
    }
    evidence.carried /= static_cast<float>(evidence.num_cells);
  }
}

}  // namespace

std::vector<ClusterEvidence> GatherEvidence(const Segmentation& segmentation, const WorkingFrame& frame,
                                            const FreeSpaceVotes& votes, const cv::Mat1f& carried,
                                            const std::vector<TrackedCorner>& corners) {
  std::vector<ClusterEvidence> all(segmentation.clusters.size());
  AddCells(segmentation, frame, votes, carried, &all);
  for (const TrackedCorner& corner : corners) {
    const int u = static_cast<int>(corner.current.x / 2), v = static_cast<int>(corner.current.y / 2);
    if (u < 0 || v < 0 || u >= frame.depth_m.cols || v >= frame.depth_m.rows) continue;
    const int label = segmentation.labels(v, u);
    if (label < 0) continue;
    ++all[label].num_corners;
    all[label].num_moving_corners += corner.residual_px > kCornerGatePx;
  }
  return all;
}

float ClusterLogOdds(const ClusterEvidence& evidence, const FusionOptions& options) {
  const auto cells = static_cast<float>(evidence.num_cells);
  float log_odds = options.prior;
  if (options.use_free_space) {
    const float judged = std::max(static_cast<float>(evidence.num_observed), options.min_observed_share * cells);
    const float share = static_cast<float>(evidence.num_suspicious) / judged;
    const float weight = std::min(1.f, static_cast<float>(evidence.num_observed) / (options.min_observed_share * cells));
    log_odds += options.free_gain * (share - options.free_share) * weight - options.prior * weight;
  }
  if (options.use_carry) log_odds += options.carry_gain * evidence.carried;
  if (options.use_klt_residual) {
    const float part = options.corner_gain * (static_cast<float>(evidence.num_moving_corners) -
                                              0.2f * static_cast<float>(evidence.num_corners - evidence.num_moving_corners));
    log_odds += std::clamp(part, -options.max_corner, options.max_corner);
  }
  if (options.use_attachment && evidence.num_border > 0) {
    const float share = static_cast<float>(evidence.num_attached) / static_cast<float>(evidence.num_border);
    log_odds -= options.attachment_gain * std::max(0.f, share - options.free_attachment);
  }
  return log_odds;
}

}  // namespace orbslam
