// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/relative_pose.h"

#include <algorithm>

#include "optimization/pose_cost.h"
#include "optimization/pose_rounds.h"
#include "optimization/ransac.h"

namespace orbslam {
namespace {

constexpr int kMinMatches = 3;
// Refinement begins with the matches within ten times the gate's width: a rough prior is forgiven, an outlier
// not.
constexpr double kPriorGateFactor = 100;

bool FallsOn(const StereoIntrinsics& intrinsics, const Eigen::Vector3d& x, const Eigen::Vector2d& pixel,
             double inverse_variance, double max_chi2) {
  if (!(x.z() > 0)) return false;
  return inverse_variance * (intrinsics.Project(x).head<2>() - pixel).squaredNorm() <= max_chi2;
}

int CountInliers(const RelativePoseProblem& problem, double max_chi2, const Rigid3d& b_from_a,
                 std::vector<char>* is_inlier) {
  const Rigid3d a_from_b = Inverse(b_from_a);
  int count = 0;
  for (size_t i = 0; i < problem.matches.size(); ++i) {
    const RelativePoseMatch& m = problem.matches[i];
    (*is_inlier)[i] =
        FallsOn(problem.intrinsics, b_from_a * m.point_a, m.pixel_b, m.inverse_variance_b, max_chi2) &&
        FallsOn(problem.intrinsics, a_from_b * m.point_b, m.pixel_a, m.inverse_variance_a, max_chi2);
    count += (*is_inlier)[i];
  }
  return count;
}

std::vector<Rigid3d> AlignSample(const RelativePoseProblem& problem, const std::array<int, 3>& sample) {
  Eigen::Matrix3Xd a(3, 3), b(3, 3);
  for (int i = 0; i < 3; ++i) {
    a.col(i) = problem.matches[sample[i]].point_a;
    b.col(i) = problem.matches[sample[i]].point_b;
  }
  if (!IsProperTriangle(a.col(0), a.col(1), a.col(2)) || !IsProperTriangle(b.col(0), b.col(1), b.col(2))) {
    return {};
  }
  return {AlignPoints(b, a)};
}

Rigid3d AlignInliers(const RelativePoseProblem& problem, const Consensus& consensus) {
  Eigen::Matrix3Xd a(3, consensus.num_inliers), b(3, consensus.num_inliers);
  int column = 0;
  for (size_t i = 0; i < problem.matches.size(); ++i) {
    if (!consensus.is_inlier[i]) continue;
    a.col(column) = problem.matches[i].point_a;
    b.col(column++) = problem.matches[i].point_b;
  }
  return AlignPoints(b, a);
}

// Observations 2 i and 2 i + 1 are the two reprojections of match i.
PoseCost BuildCost(const RelativePoseProblem& problem, const Rigid3d& b_from_a, double max_chi2) {
  PoseCost cost(problem.intrinsics, b_from_a);
  cost.Reserve(2 * problem.matches.size());
  for (const RelativePoseMatch& m : problem.matches) {
    cost.AddForward(m.point_a, {{m.pixel_b.x(), m.pixel_b.y(), -1}, m.inverse_variance_b, max_chi2});
    cost.AddBackward(m.point_b, {{m.pixel_a.x(), m.pixel_a.y(), -1}, m.inverse_variance_a, max_chi2});
  }
  return cost;
}

// A match is active with both its reprojections or with none. Returns whether any changed.
template <class IsGood>
bool ActivatePairs(PoseCost* cost, const IsGood& is_good) {
  bool has_changed = false;
  for (int i = 0; i < cost->NumObservations(); i += 2) {
    const bool is_active = is_good(i) && is_good(i + 1);
    has_changed |= is_active != cost->IsActive(i);
    cost->SetActive(i, is_active);
    cost->SetActive(i + 1, is_active);
  }
  return has_changed;
}

std::vector<char> ActiveMatches(const PoseCost& cost) {
  std::vector<char> is_active;
  for (int i = 0; i < cost.NumObservations(); i += 2) is_active.push_back(cost.IsActive(i));
  return is_active;
}

}  // namespace

std::optional<RelativePoseResult> EstimateRelativePose(const RelativePoseProblem& problem,
                                                       const RelativePoseOptions& options, Rng* rng) {
  const auto fit = [&](const std::array<int, 3>& sample) { return AlignSample(problem, sample); };
  const auto count = [&](const Rigid3d& b_from_a, std::vector<char>* is_inlier) {
    return CountInliers(problem, options.max_chi2, b_from_a, is_inlier);
  };
  const int n = static_cast<int>(problem.matches.size());
  Consensus best = FindConsensus(n, options.max_samples, options.confidence, rng, fit, count);
  if (best.num_inliers < std::max(options.min_inliers, kMinMatches)) return std::nullopt;

  Consensus joint{AlignInliers(problem, best), std::vector<char>(n), 0};
  joint.num_inliers = count(joint.pose, &joint.is_inlier);
  if (joint.num_inliers >= best.num_inliers) best = joint;
  return RelativePoseResult{best.pose, best.is_inlier, best.num_inliers};
}

RelativePoseResult RefineRelativePose(const RelativePoseProblem& problem, const Rigid3d& b_from_a,
                                      const RelativePoseOptions& options) {
  PoseCost cost = BuildCost(problem, b_from_a, options.max_chi2);
  const PoseCost::State prior = cost.At(Vector6d::Zero());
  ActivatePairs(&cost, [&](int i) { return cost.Chi2(i, prior) <= kPriorGateFactor * options.max_chi2; });
  RelativePoseResult result{b_from_a, std::vector<char>(problem.matches.size(), 0), 0};
  if (std::ranges::count(ActiveMatches(cost), 1) < kMinMatches) return result;

  const auto classify = [&cost](const PoseCost::State& state) {
    return ActivatePairs(&cost, [&](int i) { return cost.IsWithinGate(i, cost.Chi2(i, state)); });
  };
  result.b_from_a =
      cost.PoseAt(OptimizeInRounds(options.num_rounds, options.max_iterations, &cost, classify));
  result.is_inlier = ActiveMatches(cost);
  result.num_inliers = static_cast<int>(std::ranges::count(result.is_inlier, 1));
  return result;
}

}  // namespace orbslam
