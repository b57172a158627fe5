// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/stage_timer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace orbslam {
namespace {

/// Nearest-rank percentile of sorted values, fraction in (0, 1].
double Percentile(const std::vector<double>& sorted, double fraction) {
  const auto rank = static_cast<size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
  return sorted[std::clamp<size_t>(rank, 1, sorted.size()) - 1];
}

}  // namespace

void StageTimer::Add(std::string_view name, double seconds) {
  auto it = seconds_.find(name);
  if (it == seconds_.end()) it = seconds_.emplace(name, std::vector<double>()).first;
  it->second.push_back(seconds);
}

std::map<std::string, StageTimer::Statistics> StageTimer::Summarize() const {
  std::map<std::string, Statistics> summary;
  for (const auto& [name, values] : seconds_) {
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    const auto n = static_cast<double>(sorted.size());
    summary[name] = {.count = static_cast<int>(sorted.size()),
                     .mean_s = std::accumulate(sorted.begin(), sorted.end(), 0.0) / n,
                     .median_s = Percentile(sorted, 0.5),
                     .p90_s = Percentile(sorted, 0.9),
                     .p99_s = Percentile(sorted, 0.99),
                     .max_s = sorted.back()};
  }
  return summary;
}

}  // namespace orbslam
