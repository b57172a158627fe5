// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimization/noise_variance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orbslam {
namespace {

constexpr double kMedianChi2Of2 = 1.386, kMedianChi2Of3 = 2.366;
constexpr double kMost = 1;

}  // namespace

void NoiseVariance::Add(double chi2, int num_dof) {
  const double ratio = chi2 / (num_dof == 3 ? kMedianChi2Of3 : kMedianChi2Of2);
  ratios_.push_back(std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
}

double NoiseVariance::Estimate(double least) {
  if (ratios_.empty()) return 1;
  const auto median = ratios_.begin() + std::ssize(ratios_) / 2;
  std::ranges::nth_element(ratios_, median);
  return std::clamp(*median, least, kMost);
}

}  // namespace orbslam
