// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/epipolar_search.h"

#include "assignment.h"

namespace orbslam {
namespace {

constexpr double kMaxChi2 = 3.841;  // chi-square, 1 dof, 95 %: distance to the line

}  // namespace

std::vector<int> SearchByEpipolarLine(const FrameFeatures& from, std::span<const int> from_indices,
                                      const FrameFeatures& to, std::span<const int> to_indices,
                                      const Eigen::Matrix3d& fundamental, const ScalePyramid& pyramid) {
  std::vector<float> max_distance2(pyramid.num_levels());
  for (int level = 0; level < pyramid.num_levels(); ++level) {
    max_distance2[level] = static_cast<float>(kMaxChi2 / pyramid.InverseVariance(level));
  }
  Assignment assignment(static_cast<int>(from_indices.size()), to.size());
  std::vector<int> near_line;
  for (int q = 0; q < std::ssize(from_indices); ++q) {
    const cv::Point2f& pixel = from.pixels[from_indices[q]];
    const Eigen::Vector3d homogeneous = fundamental * Eigen::Vector3d(pixel.x, pixel.y, 1.0);
    const double norm = homogeneous.head<2>().norm();
    if (norm < 1e-12) continue;  // the keypoint is the epipole
    const Eigen::Vector3f line = (homogeneous / norm).cast<float>();
    near_line.clear();
    for (const int i : to_indices) {
      const float distance = line.x() * to.pixels[i].x + line.y() * to.pixels[i].y + line.z();
      if (distance * distance < max_distance2[to.levels[i]]) near_line.push_back(i);
    }
    const NearestTwo nearest = FindNearestTwo(from.descriptors[from_indices[q]], to.descriptors, near_line);
    if (nearest.index >= 0 && nearest.distance <= kStrictMaxDistance) {
      assignment.Offer(q, nearest.index, nearest.distance);
    }
  }
  assignment.RejectOddRotations(to, [&](int q) { return from.angles_deg[from_indices[q]]; });
  return assignment.Take();
}

}  // namespace orbslam
