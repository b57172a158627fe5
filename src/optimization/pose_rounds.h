// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/tiny_solver.h>

#include "optimization/pose_cost.h"

namespace orbslam {

/// Optimises in rounds, each followed by `classify(state)`, which decides anew which observations are active
/// in the next and says whether anything changed. The last of several rounds has no robust loss. Rounds that
/// could change nothing are skipped. Returns the parameters.
template <class Classify>
Vector6d OptimizeInRounds(int num_rounds, int max_iterations, PoseCost* cost, const Classify& classify) {
  ceres::TinySolver<PoseCost> solver;
  solver.options.max_num_iterations = max_iterations + 1;  // TinySolver counts the first evaluation
  // In units of chi-square, where 1 is one standard deviation: what is left is a thirtieth of it.
  solver.options.function_tolerance = 1e-3;
  Vector6d parameters = Vector6d::Zero();
  bool has_settled = false;
  for (int round = 0; round < num_rounds; ++round) {
    const bool is_last = round > 0 && round == num_rounds - 1;
    if (has_settled && !is_last) continue;
    cost->SetRobust(!is_last);
    solver.Solve(*cost, &parameters);
    has_settled = !classify(cost->At(parameters));
  }
  return parameters;
}

}  // namespace orbslam
