// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

namespace orbslam {

/// Scales of the levels of an image pyramid; level 0 is the full image.
class ScalePyramid {
 public:
  ScalePyramid(int num_levels, double factor) : factor_(factor), log_factor_(std::log(factor)) {
    for (int level = 0; level < num_levels; ++level) scales_.push_back(std::pow(factor, level));
  }

  int num_levels() const { return static_cast<int>(scales_.size()); }
  /// Between one level and the next.
  double factor() const { return factor_; }
  double Scale(int level) const { return scales_[level]; }
  /// Standard deviation of a keypoint's position, px in the full image: one pixel of its level.
  double SigmaPx(int level) const { return scales_[level]; }
  double InverseVariance(int level) const { return 1.0 / (scales_[level] * scales_[level]); }

  /// The level at which a point last seen no farther than max_distance_m appears at distance_m
  /// (ORB-SLAM 2015, section V-D).
  int PredictLevel(double max_distance_m, double distance_m) const {
    const double level = std::ceil(std::log(max_distance_m / distance_m) / log_factor_);
    if (!(level > 0)) return 0;
    return level >= num_levels() ? num_levels() - 1 : static_cast<int>(level);
  }

  friend bool operator==(const ScalePyramid&, const ScalePyramid&) = default;

 private:
  std::vector<double> scales_;
  double factor_, log_factor_;
};

}  // namespace orbslam
