// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace orbslam {

/// Squared errors over the variance that was given to them (chi-squares), of which the median tells the
/// variance that they really have: as long as most are inliers, how wrong the others are does not matter
/// (Hampel, JASA 1974).
class NoiseVariance {
 public:
  /// num_dof: 2, or 3 with a disparity. What is not a number is as wrong as can be.
  void Add(double chi2, int num_dof);

  /// As a multiple of the one that was given; 1 of no errors. At most 1, for what is above is no noise: then
  /// most are outliers. At least `least`: a gate does not profit from corners found better than to 0.2 px.
  double Estimate(double least = 0.05);

 private:
  std::vector<double> ratios_;  // to the median of a chi-square of as many degrees of freedom
};

}  // namespace orbslam
