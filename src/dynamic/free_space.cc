// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_space.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "depth_noise.h"
#include "projection.h"

namespace orbslam {
namespace {

void AddVotes(const GridCamera& camera, const cv::Mat1f& depth_m, const ReferenceView& reference,
              const FreeSpaceOptions& options, ProjectedRow* row, FreeSpaceVotes* votes) {
  const float* nearest = reference.envelope.nearest_m[0];
  const float* farthest = reference.envelope.farthest_m[0];
  const uint8_t* moving = reference.moving[0];
  const float margin0 = options.margin_m + options.drift_m * static_cast<float>(reference.age_frames);
  for (int v = 0; v < camera.height; ++v) {
    ProjectRow(camera, reference.reference_from_current, v, depth_m[v], row);
    uint8_t *num_free = votes->num_free[v], *num_static = votes->num_static[v];
    for (int u = 0; u < camera.width; ++u) {
      const int index = row->index[u];
      if (index < 0 || nearest[index] == 0) continue;
      const float z = row->depth_m[u];
      const float margin = options.gate_sigma * DepthSigmaM(nearest[index]) +
                           margin0 * (1 + options.margin_per_metre * nearest[index]);
      if (z < nearest[index] - margin) {
        ++num_free[u];
      } else if (z < farthest[index] + margin && moving[index] == 0) {
        ++num_static[u];
      }
    }
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
  ProjectedRow row(camera.width);
  for (const ReferenceView* reference : references)
    AddVotes(camera, depth_m, *reference, options, &row, &votes);

  cv::Mat1b candidate(depth_m.size(), uint8_t{0});
  for (int i = 0; i < static_cast<int>(depth_m.total()); ++i) {
    const int num_free = votes.num_free(i), num_static = votes.num_static(i);
    candidate(i) = static_cast<float>(num_free) - 0.5f * static_cast<float>(num_static) >= options.min_votes;
    votes.confirmed_static(i) = num_free == 0 && num_static > 0 ? 255 : 0;
  }
  cv::Mat1b count;
  cv::boxFilter(candidate, count, -1, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
  for (int i = 0; i < static_cast<int>(depth_m.total()); ++i)
    votes.suspicious(i) = candidate(i) != 0 && count(i) >= options.min_suspicious_neighbors ? 255 : 0;
  return votes;
}

void WithdrawStatic(const cv::Mat1b& cells, FreeSpaceVotes* votes) {
  votes->confirmed_static.setTo(0, cells);
  votes->num_static.setTo(0, cells);
}

}  // namespace orbslam
