// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cluster_facts.h"
#include "orbslam/dynamic/dynamic_detector_options.h"

namespace orbslam {

/// One source of evidence: how much it changes the log-odds that a cluster moves.
class Evidence {
 public:
  virtual ~Evidence() = default;
  virtual float LogOdds(const ClusterFacts& facts) const = 0;
};

/// Those that the options switch on.
std::vector<std::unique_ptr<Evidence>> MakeEvidence(const FusionOptions& options);

/// The sum of all evidence and the prior.
float FuseEvidence(std::span<const std::unique_ptr<Evidence>> sources, const ClusterFacts& facts,
                   const FusionOptions& options);

/// What a line integral, in units of tau, adds.
float HistogramLogOdds(double integral_over_tau, const FusionOptions& options);

}  // namespace orbslam
