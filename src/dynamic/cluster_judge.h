// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cluster_facts.h"
#include "evidence.h"
#include "histogram_evidence.h"

namespace orbslam {

struct ClusterVerdict {
  float log_odds = 0;             // positive: it moves
  ClusterMotion motion;           // by the histogram; zero: not asked
  bool may_ask_velocity = false;  // it moves, and is among the few for which there is time to ask
};

/// Judges clusters by all evidence, and lets the motion histogram decide where that leaves it open.
class ClusterJudge {
 public:
  ClusterJudge(const FusionOptions& fusion, const HistogramOptions& histogram)
      : fusion_(fusion), histogram_(histogram), evidence_(MakeEvidence(fusion)) {}

  /// facts: of each cluster. window: nullptr where it cannot be asked. corners: in the present frame.
  std::vector<ClusterVerdict> Judge(const Segmentation& segmentation, std::span<const ClusterFacts> facts,
                                    const HistogramWindow* window,
                                    std::span<const TrackedCorner> corners) const;

 private:
  void AskHistogram(const Segmentation& segmentation, std::span<const ClusterFacts> facts,
                    const HistogramWindow& window, std::span<const TrackedCorner> corners,
                    std::span<ClusterVerdict> verdicts) const;

  FusionOptions fusion_;
  HistogramOptions histogram_;
  std::vector<std::unique_ptr<Evidence>> evidence_;
};

}  // namespace orbslam
