// SPDX-License-Identifier: GPL-3.0-or-later
#include "object_velocity.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace orbslam {

void SetVelocities(const Segmentation& segmentation, std::span<const ClusterVerdict> verdicts,
                   const cv::Mat1f& log_odds, const HistogramWindow& window,
                   std::span<const TrackedCorner> corners, ObjectTracker::Labelled* labelled) {
  const std::vector<Cluster>& clusters = segmentation.clusters;
  std::vector<int> order(verdicts.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](int c) { return clusters[c].cells.size(); });
  std::vector<bool> is_set(labelled->objects.size(), false);
  for (const int c : order) {
    const int cell = clusters[c].cells.front(), index = labelled->object_of_cell(cell);
    if (index < 0 || is_set[index] || log_odds(cell) <= 0) continue;
    ClusterMotion motion = verdicts[c].motion;
    if (verdicts[c].may_ask_velocity) motion = window.Motion(clusters[c], corners);
    if (motion.direction.isZero()) continue;
    labelled->objects[index].velocity_mps = motion.velocity_mps.cast<double>();
    labelled->objects[index].line_integral_ratio = motion.ratio / kPersistentTau;
    is_set[index] = true;
  }
}

}  // namespace orbslam
