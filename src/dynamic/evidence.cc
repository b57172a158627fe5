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
    if (label < 0) continue;
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
      all[c].carried += carried(cell) / static_cast<float>(cells.size());
    }
  }
  for (const Flow& flow : flows) {
    const bool only_holds = &flow != &flows.front() && !flow.gate.IsSharp();
    AddCorners(segmentation, flow, only_holds ? &carried : nullptr, &all);
  }
  return all;
}

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
