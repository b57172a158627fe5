// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_space.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "cells.h"
#include "depth_noise.h"
#include "projection.h"
#include "wide_vectors.h"

namespace orbslam {
namespace {

/// What a reference saw where each cell of a row falls: an interval of depths, [0, 0] where it knows none, and
/// whether that moved.
struct SeenRow {
  explicit SeenRow(int width) : nearest_m(width), farthest_m(width), moving(width) {}
  std::vector<float> nearest_m, farthest_m;
  std::vector<int> moving;
};

void LookUp(const ReferenceView& reference, const ProjectedRow& row, SeenRow* seen) {
  const float* nearest_m = reference.envelope.nearest_m[0];
  const float* farthest_m = reference.envelope.farthest_m[0];
  const uint8_t* moving = reference.moving[0];
  for (size_t u = 0; u < row.index.size(); ++u) {
    const int somewhere = std::max(row.index[u], 0);
    seen->nearest_m[u] = row.index[u] < 0 ? 0.f : nearest_m[somewhere];
    seen->farthest_m[u] = farthest_m[somewhere];
    seen->moving[u] = moving[somewhere];
  }
}

/// Without branches, so that the compiler vectorises it.
void AddRow(const SeenRow& seen, const ProjectedRow& row, FreeSpaceOptions options, float margin0,
            uint8_t weight, uint8_t* num_free, uint8_t* num_static) {
  const float *depth_m = row.depth_m.data(), *nearest_m = seen.nearest_m.data(),
              *farthest_m = seen.farthest_m.data();
  const int* moving = seen.moving.data();
  const int width = static_cast<int>(row.index.size());
  for (int u = 0; u < width; ++u) {
    const float z = depth_m[u], nearest = nearest_m[u];
    const float margin =
        options.gate_sigma * DepthSigmaM(nearest) + margin0 * (1 + options.margin_per_metre * nearest);
    const bool is_known = nearest != 0, is_before = z < nearest - margin;
    const bool is_there = (z < farthest_m[u] + margin) & (moving[u] == 0);
    num_free[u] = static_cast<uint8_t>(num_free[u] + (is_known & is_before) * weight);
    num_static[u] = static_cast<uint8_t>(num_static[u] + (is_known & !is_before & is_there));
  }
}

ORBSLAM_WIDE_VECTORS void AddRowWide(const SeenRow& seen, const ProjectedRow& row, FreeSpaceOptions options,
                                     float margin0, uint8_t weight, uint8_t* num_free, uint8_t* num_static) {
  AddRow(seen, row, options, margin0, weight, num_free, num_static);
}

void AddVotes(const GridCamera& camera, const cv::Mat1f& depth_m, const ReferenceView& reference,
              const FreeSpaceOptions& options, FreeSpaceVotes* votes) {
  const float margin0 = options.margin_m + options.drift_m * static_cast<float>(reference.age_frames);
  const auto add_row = HasWideVectors() ? AddRowWide : AddRow;
  const auto weight = static_cast<uint8_t>(reference.half_votes);
  ProjectedRow row(camera.width);
  SeenRow seen(camera.width);
  for (int v = 0; v < camera.height; ++v) {
    ProjectRow(camera, reference.reference_from_current, v, depth_m[v], &row);
    LookUp(reference, row, &seen);
    add_row(seen, row, options, margin0, weight, votes->num_free[v], votes->num_static[v]);
  }
}

}  // namespace

FreeSpaceVotes VoteOnFreeSpace(const GridCamera& camera, const cv::Mat1f& depth_m,
                               std::span<const ReferenceView* const> references,
                               const FreeSpaceOptions& options) {
  FreeSpaceVotes votes;
  votes.num_free = cv::Mat1b::zeros(depth_m.size());
  votes.num_static = cv::Mat1b::zeros(depth_m.size());
  votes.suspicious = cv::Mat1b::zeros(depth_m.size());
  votes.confirmed_static = cv::Mat1b::zeros(depth_m.size());
  for (const ReferenceView* reference : references)
    AddVotes(camera, depth_m, *reference, options, &votes);

  cv::Mat1b candidate(depth_m.size(), uint8_t{0}), count;
  const auto num_free = Cells(votes.num_free), num_static = Cells(votes.num_static);
  const auto is_candidate = Cells(candidate), is_static = Cells(votes.confirmed_static);
  for (size_t i = 0; i < num_free.size(); ++i) {
    is_candidate[i] = 0.5f * static_cast<float>(num_free[i] - num_static[i]) >= options.min_votes;
    is_static[i] = num_free[i] == 0 && num_static[i] > 0 ? 255 : 0;
  }
  cv::boxFilter(candidate, count, -1, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::compare(count, options.min_suspicious_neighbors, votes.suspicious, cv::CMP_GE);
  votes.suspicious.setTo(0, candidate == 0);
  return votes;
}

void WithdrawStatic(const cv::Mat1b& cells, FreeSpaceVotes* votes) {
  votes->confirmed_static.setTo(0, cells);
  votes->num_static.setTo(0, cells);
}

}  // namespace orbslam
