// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_space.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "depth_noise.h"

namespace orbslam {
namespace {

/// A row of cells as seen from a reference: its cell there (-1: none) and its depth there.
struct ProjectedRow {
  std::vector<int> index;
  std::vector<float> depth_m;
};

void ProjectRow(const GridCamera& camera, const Rigid3d& pose, int v, const float* depth, ProjectedRow* row) {
  const Eigen::Matrix3f r = pose.RotationMatrix().cast<float>();
  const Eigen::Vector3f t = pose.translation.cast<float>();
  const float b = (static_cast<float>(v) - camera.cy) / camera.fy, inverse_fx = 1 / camera.fx;
  // A ray's direction in the reference is linear in u.
  const Eigen::Vector3f first = r * Eigen::Vector3f(-camera.cx * inverse_fx, b, 1), step = r.col(0) * inverse_fx;
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  int* index = row->index.data();
  float* out = row->depth_m.data();
  for (int u = 0; u < camera.width; ++u) {
    const float z = depth[u], n = static_cast<float>(u);
    const float qz = (first.z() + n * step.z()) * z + t.z();
    const float inverse = 1 / qz;
    const float pu = ((first.x() + n * step.x()) * z + t.x()) * inverse * camera.fx + camera.cx + 0.5f;
    const float pv = ((first.y() + n * step.y()) * z + t.y()) * inverse * camera.fy + camera.cy + 0.5f;
    const bool inside = z > 0 && qz > 0.1f && pu >= 0 && pv >= 0 && pu < width && pv < height;
    out[u] = qz;
    index[u] = inside ? static_cast<int>(pv) * camera.width + static_cast<int>(pu) : -1;
  }
}

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
                               std::span<const ReferenceView* const> references, const FreeSpaceOptions& options) {
  FreeSpaceVotes votes;
  votes.num_free = cv::Mat1b::zeros(depth_m.size());
  votes.num_static = cv::Mat1b::zeros(depth_m.size());
  votes.suspicious = cv::Mat1b::zeros(depth_m.size());
  votes.confirmed_static = cv::Mat1b::zeros(depth_m.size());
  ProjectedRow row{std::vector<int>(camera.width), std::vector<float>(camera.width)};
  for (const ReferenceView* reference : references) AddVotes(camera, depth_m, *reference, options, &row, &votes);

  cv::Mat1b candidate = cv::Mat1b::zeros(depth_m.size());
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

}  // namespace orbslam
