// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "icp.h"

namespace orbslam {

/// The normal equations of one step, J^T W J and J^T W residual, each element in parts that are added side by
/// side.
class PairSums {
 public:
  static constexpr int kLanes = 8;    // floats of a vector
  static constexpr int kColumns = 7;  // the parameters, and the residual

  /// Row a <= column b of J^T W (J, residual).
  float operator()(int a, int b) const;

  float lanes[6][kColumns][kLanes] = {};
  int num_pairs = 0;    // points that met a surface
  int num_fitting = 0;  // of them, within the gate
};

/// Adds the pairs of the source points, every stride cells, with one target at the given pose. The
/// perturbation (rotation w, translation v) acts in the source frame: x -> x + w x x + v. ignored_source:
/// cells, non-zero: left out; may be null.
void AddPairs(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
              const IcpTarget& target, const Rigid3d& target_from_source, const IcpOptions& options,
              int stride, PairSums* sums);

}  // namespace orbslam
