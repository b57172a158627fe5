// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_space.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "cells.h"
#include "depth_noise.h"
#include "projection.h"
#include "wide_vectors.h"

namespace orbslam {
namespace {

/// What a reference saw where each cell of a row falls: its nearest and farthest depth, 0, 0 where it knows
/// none, and whether that moved.
struct SeenRow {
  explicit SeenRow(int width) : envelope_m(width), moving(width) {}
  std::vector<cv::Vec2f> envelope_m;
  std::vector<int> moving;
};

void LookUp(const ReferenceView& reference, const ProjectedRow& row, SeenRow* seen) {
  constexpr size_t kPerLine = 8;  // of the cache
  const cv::Vec2f* envelope_m = reference.envelope_m[0];
  const uint8_t* moving = reference.moving[0];
  const int ahead = reference.envelope_m.cols, last = static_cast<int>(reference.envelope_m.total()) - 1;
  for (size_t u = 0; u < row.index.size(); u += kPerLine)  // where about the next row will fall
    __builtin_prefetch(envelope_m + std::min(row.index[u] + ahead, last));
  for (size_t u = 0; u < row.index.size(); ++u) {
    seen->envelope_m[u] = envelope_m[row.index[u]];
    seen->moving[u] = moving[row.index[u]];
  }
}

/// Without branches, so that the compiler vectorises it.
void AddRow(const SeenRow& seen, const ProjectedRow& row, FreeSpaceOptions options, float margin0,
            uint8_t weight, uint8_t* num_free, uint8_t* num_static) {
  const float *depth_m = row.depth_m.data(), *envelope_m = seen.envelope_m.front().val;
  const int* moving = seen.moving.data();
  const int width = static_cast<int>(row.index.size());
  for (int u = 0; u < width; ++u) {
    const float z = depth_m[u], nearest = envelope_m[2 * u], farthest = envelope_m[2 * u + 1];
    const float margin =
        options.gate_sigma * DepthSigmaM(nearest) + margin0 * (1 + options.margin_per_metre * nearest);
    const bool is_known = nearest != 0, is_before = z < nearest - margin;
    const bool is_there = (z < farthest + margin) & (moving[u] == 0);
    num_free[u] = static_cast<uint8_t>(num_free[u] + (is_known & is_before) * weight);
    num_static[u] = static_cast<uint8_t>(num_static[u] + (is_known & !is_before & is_there));
  }
}

ORBSLAM_WIDE_VECTORS void AddRowWide(const SeenRow& seen, const ProjectedRow& row, FreeSpaceOptions options,
                                     float margin0, uint8_t weight, uint8_t* num_free, uint8_t* num_static) {
  AddRow(seen, row, options, margin0, weight, num_free, num_static);
}

/// One reference's, under one of the rules.
class RowAdder {
 public:
  RowAdder(const ReferenceView& reference, const SightingRules& rules, Sightings* sightings)
      : options_(rules.options),
        margin0_(options_.margin_m + options_.drift_m * static_cast<float>(reference.age_frames)),
        weight_(static_cast<uint8_t>(reference.half_votes)),
        sightings_(sightings) {}

  void Add(int v, const SeenRow& seen, const ProjectedRow& row) const {
    (HasWideVectors() ? AddRowWide : AddRow)(seen, row, options_, margin0_, weight_, sightings_->num_free[v],
                                             sightings_->num_static[v]);
  }

 private:
  FreeSpaceOptions options_;
  float margin0_;
  uint8_t weight_;
  Sightings* sightings_;
};

}  // namespace

std::vector<Sightings> CountSightings(const GridCamera& camera, const cv::Mat1f& depth_m,
                                      std::span<const ReferenceView* const> references,
                                      std::span<const SightingRules> rules) {
  std::vector<Sightings> sightings(rules.size());
  for (Sightings& counts : sightings)
    counts = {cv::Mat1b(depth_m.size(), uint8_t{0}), cv::Mat1b(depth_m.size(), uint8_t{0})};
  ProjectedRow row(camera.width);
  SeenRow seen(camera.width);
  for (const ReferenceView* reference : references) {
    std::vector<RowAdder> adders;
    for (size_t i = 0; i < rules.size(); ++i)
      if (reference->age_frames >= rules[i].min_age_frames)
        adders.emplace_back(*reference, rules[i], &sightings[i]);
    for (int v = 0; v < camera.height && !adders.empty(); ++v) {
      ProjectRow(camera, reference->reference_from_current, v, depth_m[v], &row);
      LookUp(*reference, row, &seen);
      for (const RowAdder& adder : adders) adder.Add(v, seen, row);
    }
  }
  return sightings;
}

FreeSpaceVotes VoteOnFreeSpace(const GridCamera& camera, const cv::Mat1f& depth_m,
                               std::span<const ReferenceView* const> references,
                               const FreeSpaceOptions& options) {
  const SightingRules rules{options};
  return VoteOnFreeSpace(CountSightings(camera, depth_m, references, {&rules, 1}).front(), options);
}

FreeSpaceVotes VoteOnFreeSpace(Sightings sightings, const FreeSpaceOptions& options) {
  FreeSpaceVotes votes{std::move(sightings), {}, {}};
  votes.confirmed_static = cv::Mat1b(votes.num_free.size());
  cv::Mat1b candidate(votes.num_free.size());
  const auto num_free = Cells(votes.num_free), num_static = Cells(votes.num_static);
  const auto is_candidate = Cells(candidate), is_static = Cells(votes.confirmed_static);
  for (size_t i = 0; i < num_free.size(); ++i) {
    is_candidate[i] = 0.5f * static_cast<float>(num_free[i] - num_static[i]) >= options.min_votes;
    is_static[i] = num_free[i] == 0 && num_static[i] > 0 ? 255 : 0;
  }
  cv::compare(CountAround(candidate), options.min_suspicious_neighbors, votes.suspicious, cv::CMP_GE);
  votes.suspicious.setTo(0, candidate == 0);
  return votes;
}

void WithdrawStatic(const cv::Mat1b& cells, FreeSpaceVotes* votes) {
  votes->confirmed_static.setTo(0, cells);
  votes->num_static.setTo(0, cells);
}

}  // namespace orbslam
