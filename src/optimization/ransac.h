// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/util/random.h"

namespace orbslam {

/// The hypothesis with most inliers.
struct Consensus {
  Rigid3d pose;
  std::vector<char> is_inlier;
  int num_inliers = 0;
};

/// Three different indices below n, n >= 3.
inline std::array<int, 3> DrawThree(int n, Rng* rng) {
  std::array<int, 3> sample{};
  do {
    for (int& i : sample) i = static_cast<int>(rng->Below(static_cast<uint32_t>(n)));
  } while (sample[0] == sample[1] || sample[1] == sample[2] || sample[2] == sample[0]);
  return sample;
}

/// False for triangles that are nearly a line or a point: they do not determine a rotation. False for NaN.
inline bool IsProperTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr double kMinSideM = 0.02, kMinSine = 0.05;
  const double sides[] = {(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
  const double longest = *std::ranges::max_element(sides), shortest = *std::ranges::min_element(sides);
  return shortest > kMinSideM * kMinSideM && (b - a).cross(c - a).norm() > kMinSine * longest;
}

/// How many samples of three make one without outliers likely.
inline int SamplesNeeded(int num_inliers, int n, double confidence, int max_samples) {
  const double inlier_share = static_cast<double>(num_inliers) / n;
  const double miss = 1 - inlier_share * inlier_share * inlier_share;
  if (miss <= 0) return 1;
  const double needed = std::ceil(std::log(1 - confidence) / std::log(miss));
  return needed < max_samples ? std::max(1, static_cast<int>(needed)) : max_samples;
}

/// RANSAC. `fit(sample)` gives the poses that three of n things suggest, none for a degenerate sample;
/// `count(pose, &is_inlier)` judges all n.
template <class Fit, class Count>
Consensus FindConsensus(int n, int max_samples, double confidence, Rng* rng, const Fit& fit,
                        const Count& count) {
  Consensus best;
  if (n < 3) return best;
  std::vector<char> is_inlier(n);
  int samples_needed = max_samples;
  for (int i = 0; i < samples_needed; ++i) {
    for (const Rigid3d& pose : fit(DrawThree(n, rng))) {
      const int num_inliers = count(pose, &is_inlier);
      if (num_inliers <= best.num_inliers) continue;
      best = {pose, is_inlier, num_inliers};
      samples_needed = SamplesNeeded(num_inliers, n, confidence, max_samples);
    }
  }
  return best;
}

}  // namespace orbslam
