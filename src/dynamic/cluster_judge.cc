// SPDX-License-Identifier: GPL-3.0-or-later
#include "cluster_judge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace orbslam {

std::vector<ClusterVerdict> ClusterJudge::Judge(const Segmentation& segmentation,
                                                std::span<const ClusterFacts> facts,
                                                const HistogramWindow* window,
                                                std::span<const TrackedCorner> corners) const {
  std::vector<ClusterVerdict> verdicts(facts.size());
  std::ranges::transform(facts, verdicts.begin(), [this](const ClusterFacts& cluster) {
    ClusterVerdict verdict;
    verdict.log_odds = FuseEvidence(evidence_, cluster, fusion_);
    return verdict;
  });
  if (window != nullptr) AskHistogram(segmentation, facts, *window, corners, verdicts);
  return verdicts;
}

/// The largest undecided clusters are decided by it; the largest moving ones may be given their velocity.
void ClusterJudge::AskHistogram(const Segmentation& segmentation, std::span<const ClusterFacts> facts,
                                const HistogramWindow& window, std::span<const TrackedCorner> corners,
                                std::span<ClusterVerdict> verdicts) const {
  std::vector<int> order(facts.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](int c) { return facts[c].num_cells; });
  int asked = 0;
  for (const int c : order) {
    if (facts[c].num_cells < histogram_.min_cells || asked >= histogram_.max_clusters) break;
    ClusterVerdict& verdict = verdicts[c];
    const bool decides = fusion_.use_histogram && std::abs(verdict.log_odds) < fusion_.undecided;
    if (!decides && !(histogram_.use_velocity && verdict.log_odds > 0)) continue;
    verdict.may_ask_velocity = !decides;
    ++asked;
    if (!decides) continue;
    verdict.motion = window.Motion(segmentation.clusters[c], corners);
    verdict.log_odds += HistogramLogOdds(verdict.motion.ratio / kPersistentTau, fusion_);
  }
}

}  // namespace orbslam
