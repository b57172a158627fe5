// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence.h"

#include <algorithm>
#include <cmath>

namespace orbslam {
namespace {

/// Share of the cluster that is judged, as the weight of that judgement: 1 from min_judged_share on.
float JudgedWeight(const ClusterFacts& facts, const FusionOptions& options) {
  return std::min(1.f, static_cast<float>(facts.num_judged) /
                           (options.min_judged_share * static_cast<float>(facts.num_cells)));
}

/// Stands in space that was seen empty. Where it is judged, it replaces the prior, which is for what nobody
/// knows.
class FreeSpaceEvidence : public Evidence {
 public:
  explicit FreeSpaceEvidence(const FusionOptions& options) : options_(options) {}
  float LogOdds(const ClusterFacts& facts) const override {
    const float judged = std::max(static_cast<float>(facts.num_judged),
                                  options_.min_judged_share * static_cast<float>(facts.num_cells));
    const float share = static_cast<float>(facts.num_suspicious) / judged;
    return (options_.free_gain * (share - options_.free_share) - options_.prior) *
           JudgedWeight(facts, options_);
  }

 private:
  FusionOptions options_;
};

/// Was moving in the last frame.
class CarriedEvidence : public Evidence {
 public:
  explicit CarriedEvidence(const FusionOptions& options) : options_(options) {}
  float LogOdds(const ClusterFacts& facts) const override { return options_.carry_gain * facts.carried; }

 private:
  FusionOptions options_;
};

/// Its corners do not move as static ones would.
class CornerEvidence : public Evidence {
 public:
  explicit CornerEvidence(const FusionOptions& options) : options_(options) {}
  float LogOdds(const ClusterFacts& facts) const override {
    constexpr float kRestingShare = 0.2f;  // a corner on a limb's axis of motion, or on its background, rests
    const auto moving = static_cast<float>(facts.num_moving_corners);
    const float resting = static_cast<float>(facts.num_corners) - moving;
    return std::clamp(options_.corner_gain * (moving - kRestingShare * resting), -options_.max_resting,
                      options_.max_corner * facts.sharpness * facts.sharpness);
  }

 private:
  FusionOptions options_;
};

/// Continues into static surfaces: an edge of one of them, seen from a new side, rather than a thing.
class AttachmentEvidence : public Evidence {
 public:
  explicit AttachmentEvidence(const FusionOptions& options) : options_(options) {}
  float LogOdds(const ClusterFacts& facts) const override {
    if (facts.num_border == 0) return 0;
    const float share = static_cast<float>(facts.num_attached) / static_cast<float>(facts.num_border);
    return -options_.attachment_gain * std::max(0.f, share - options_.free_attachment);
  }

 private:
  FusionOptions options_;
};

/// Is hardly wider than what an alignment that is off by a pixel uncovers at the edge of a static thing.
class ThicknessEvidence : public Evidence {
 public:
  explicit ThicknessEvidence(const FusionOptions& options) : options_(options) {}
  float LogOdds(const ClusterFacts& facts) const override {
    const float share = static_cast<float>(facts.num_interior) / static_cast<float>(facts.num_cells);
    return -options_.max_thin * std::max(0.f, 1 - share / options_.thick_share);
  }

 private:
  FusionOptions options_;
};

}  // namespace

std::vector<std::unique_ptr<Evidence>> MakeEvidence(const FusionOptions& options) {
  std::vector<std::unique_ptr<Evidence>> sources;
  if (options.use_free_space) sources.push_back(std::make_unique<FreeSpaceEvidence>(options));
  if (options.use_carry) sources.push_back(std::make_unique<CarriedEvidence>(options));
  if (options.use_klt_residual) sources.push_back(std::make_unique<CornerEvidence>(options));
  if (options.use_attachment) sources.push_back(std::make_unique<AttachmentEvidence>(options));
  if (options.use_thickness) sources.push_back(std::make_unique<ThicknessEvidence>(options));
  return sources;
}

float FuseEvidence(std::span<const std::unique_ptr<Evidence>> sources, const ClusterFacts& facts,
                   const FusionOptions& options) {
  float log_odds = options.prior;
  for (const auto& source : sources) log_odds += source->LogOdds(facts);
  return log_odds;
}

float HistogramLogOdds(double integral_over_tau, const FusionOptions& options) {
  return std::clamp(options.histogram_gain * static_cast<float>(integral_over_tau - 1),
                    -options.max_histogram, options.max_histogram);
}

}  // namespace orbslam
