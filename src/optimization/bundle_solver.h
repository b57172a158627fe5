// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <deque>
#include <optional>
#include <stop_token>
#include <vector>

#include "optimization/pose_block.h"
#include "optimization/reprojection_cost.h"
#include "orbslam/optimization/bundle_adjuster.h"

namespace orbslam {

/// One Ceres problem that serves both rounds: between them observations are switched off and the loss is
/// dropped, nothing is rebuilt. Works on copies; `problem` must outlive it.
class BundleSolver {
 public:
  BundleSolver(const BundleOptions& options, const BundleProblem& problem);

  /// Stops early when the cost falls by less than its function_tolerance-th part.
  ceres::Solver::Summary Solve(int max_iterations, double function_tolerance, const std::stop_token& stop);
  /// Judges every observation at the present estimate; 1 for an inlier.
  std::vector<char> Classify() const;
  /// From now on only these count, and without robust loss.
  void KeepOnly(const std::vector<char>& is_inlier);
  /// Writes free poses, and the points that have an inlier.
  void Export(const std::vector<char>& is_inlier, BundleProblem* problem) const;

 private:
  /// Huber's loss until it is dropped.
  class Loss final : public ceres::LossFunction {
   public:
    explicit Loss(double max_chi2) : huber_(std::sqrt(max_chi2)) {}
    void Drop() { is_dropped_ = true; }
    void Evaluate(double chi2, double out[3]) const override;

   private:
    ceres::HuberLoss huber_;
    bool is_dropped_ = false;
  };

  void AddParameters();
  void AddResiduals();
  std::vector<double> DepthWeights() const;  // one a point
  /// By how much the gates shrink, given the errors.
  double GateScale(const std::vector<double>& chi2) const;
  std::vector<double> Chi2() const;  // one an observation
  void RejectUnsteadyPoints(const std::vector<double>& chi2, std::vector<char>* is_inlier) const;

  const BundleOptions options_;
  const BundleProblem& input_;
  std::vector<PoseBlock> poses_;
  std::vector<Eigen::Vector3d> points_;
  ceres::EigenQuaternionManifold manifold_;
  std::optional<Loss> mono_loss_, stereo_loss_;
  std::deque<ReprojectionCost> costs_;  // one an observation; a deque, as what Ceres points to may not move
  ceres::Problem ceres_;
};

}  // namespace orbslam
