// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/depth_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace orbslam {

double SplitDepthM(const std::vector<double>& depths_m) {
  std::vector<double> logs;
  for (const double depth_m : depths_m) logs.push_back(std::log(depth_m));
  std::ranges::sort(logs);
  double rest = std::accumulate(logs.begin(), logs.end(), 0.0), sum = 0, best = 0, split_m = 0;
  for (size_t i = 0; i + 1 < logs.size(); ++i) {
    sum += logs[i], rest -= logs[i];
    const auto below = static_cast<double>(i + 1), above = static_cast<double>(logs.size()) - below;
    const double gap = rest / above - sum / below, between = below * above * gap * gap;
    if (logs[i] < logs[i + 1] && between > best)
      best = between, split_m = std::exp((logs[i] + logs[i + 1]) / 2);
  }
  return split_m;
}

}  // namespace orbslam
