// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/orientation_check.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace orbslam {

void OrientationCheck::Add(int match, float from_angle_deg, float to_angle_deg) {
  float rotation = to_angle_deg - from_angle_deg;
  if (rotation < 0) rotation += 360.0f;
  bins_[static_cast<int>(rotation / (360.0f / kBins)) % kBins].push_back(match);
}

std::vector<int> OrientationCheck::Outliers() const {
  std::array<int, kBins> order;
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](int bin) { return bins_[bin].size(); });
  std::array<bool, kBins> wins{};
  for (int rank = 0; rank < 3; ++rank) {
    wins[order[rank]] = 10 * bins_[order[rank]].size() >= bins_[order[0]].size();
  }
  std::vector<int> outliers;
  for (int bin = 0; bin < kBins; ++bin) {
    if (!wins[bin]) outliers.insert(outliers.end(), bins_[bin].begin(), bins_[bin].end());
  }
  return outliers;
}

}  // namespace orbslam
