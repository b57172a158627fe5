// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace orbslam {

/// Finds the matches whose change of keypoint angle disagrees with the others': a camera that rolls turns all
/// patches alike. Rotations are counted in a histogram of 12 degree bins; the three fullest bins are right,
/// if each has at least a tenth of the fullest (ORB-SLAM 2015, section V-B).
class OrientationCheck {
 public:
  /// Angles in [0, 360).
  void Add(int match, float from_angle_deg, float to_angle_deg);
  /// The matches that were added and lie outside the winning bins, ascending in bin.
  std::vector<int> Outliers() const;

 private:
  static constexpr int kBins = 30;
  std::vector<int> bins_[kBins];
};

}  // namespace orbslam
