// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/pose_optimizer.h"

#include <cmath>

#include "optimization/pose_cost.h"
#include "optimization/pose_rounds.h"

namespace orbslam {
namespace {

constexpr int kMinObservations = 3;

PoseCost BuildCost(const PoseProblem& problem, const PoseOptimizerOptions& options) {
  PoseCost cost(problem.intrinsics, problem.camera_from_world);
  cost.Reserve(problem.observations.size());
  for (const PoseObservation& o : problem.observations) {
    const double max_chi2 = o.pixel.z() < 0 ? options.max_chi2_mono : options.max_chi2_stereo;
    cost.AddForward(o.point_world, {o.pixel, o.inverse_variance, max_chi2});
  }
  return cost;
}

// At the prior only what cannot be used at all is left out: points behind the camera, values that are not
// finite.
int ActivateUsable(PoseCost* cost) {
  const PoseCost::State prior = cost->At(Vector6d::Zero());
  int num_active = 0;
  for (int i = 0; i < cost->NumObservations(); ++i) {
    cost->SetActive(i, std::isfinite(cost->Chi2(i, prior)));
    num_active += cost->IsActive(i);
  }
  return num_active;
}

bool Reclassify(const PoseCost::State& state, PoseCost* cost) {
  const std::vector<double> chi2 = cost->Chi2(state);
  cost->AdaptGates(chi2);
  bool has_changed = false;
  for (int i = 0; i < cost->NumObservations(); ++i) {
    const bool is_inlier = cost->IsWithinGate(i, chi2[i]);
    has_changed |= is_inlier != cost->IsActive(i);
    cost->SetActive(i, is_inlier);
  }
  return has_changed;
}

}  // namespace

PoseResult OptimizePose(const PoseProblem& problem, const PoseOptimizerOptions& options) {
  PoseResult result{problem.camera_from_world, std::vector<char>(problem.observations.size(), 0), 0};
  PoseCost cost = BuildCost(problem, options);
  if (ActivateUsable(&cost) < kMinObservations) return result;

  const Vector6d parameters =
      OptimizeInRounds(options.num_rounds, options.max_iterations, &cost,
                       [&cost](const PoseCost::State& state) { return Reclassify(state, &cost); });
  result.camera_from_world = cost.PoseAt(parameters);
  result.information = cost.Information(cost.At(parameters));
  for (int i = 0; i < cost.NumObservations(); ++i) {
    result.is_inlier[i] = cost.IsActive(i);
    result.num_inliers += cost.IsActive(i);
  }
  return result;
}

}  // namespace orbslam
