// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/bundle_adjuster.h"

#include "optimization/bundle_solver.h"

namespace orbslam {
namespace {

// The first round only has to tell outliers from inliers.
constexpr double kRobustTolerance = 1e-4, kFinalTolerance = 1e-7;

int NumIterations(const ceres::Solver::Summary& summary) {
  return summary.num_successful_steps + summary.num_unsuccessful_steps;
}

// The second round: plain least squares of what agreed after the first.
void Refine(const BundleOptions& options, const std::stop_token& stop, BundleSolver* solver,
            BundleSummary* summary) {
  if (options.final_iterations <= 0 || stop.stop_requested()) return;
  solver->KeepOnly(solver->Classify());
  const ceres::Solver::Summary round = solver->Solve(options.final_iterations, kFinalTolerance, stop);
  summary->num_iterations += NumIterations(round);
  summary->is_usable = round.IsSolutionUsable();
}

}  // namespace

BundleSummary SolveBundle(const BundleOptions& options, std::stop_token stop, BundleProblem* problem) {
  BundleSummary summary;
  BundleSolver solver(options, *problem);
  if (stop.stop_requested()) {
    summary.is_inlier = solver.Classify();
    summary.is_usable = summary.was_stopped = true;
    return summary;
  }
  const ceres::Solver::Summary first = solver.Solve(options.robust_iterations, kRobustTolerance, stop);
  summary.initial_cost = first.initial_cost;
  summary.final_cost = first.final_cost;
  summary.num_iterations = NumIterations(first);
  summary.is_usable = first.IsSolutionUsable();
  if (summary.is_usable) Refine(options, stop, &solver, &summary);
  summary.is_inlier = solver.Classify();
  summary.was_stopped = stop.stop_requested();
  if (summary.is_usable) solver.Export(summary.is_inlier, problem);
  return summary;
}

}  // namespace orbslam
