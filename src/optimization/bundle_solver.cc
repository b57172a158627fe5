// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimization/bundle_solver.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "optimization/noise_variance.h"
#include "optimization/stop_callback.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

constexpr int kPointsGroup = 0, kPosesGroup = 1;  // of elimination

ceres::LinearSolverType CeresType(BundleOptions::Solver solver) {
  switch (solver) {
    case BundleOptions::Solver::kDenseSchur:
      return ceres::DENSE_SCHUR;
    case BundleOptions::Solver::kSparseSchur:
      return ceres::SPARSE_SCHUR;
    case BundleOptions::Solver::kIterativeSchur:
      return ceres::ITERATIVE_SCHUR;
  }
  return ceres::DENSE_SCHUR;
}

double MedianOf(std::vector<double>* values) {
  const auto median = values->begin() + std::ssize(*values) / 2;
  std::ranges::nth_element(*values, median);
  return *median;
}

bool IsMono(const BundleObservation& o) { return o.pixel.z() < 0; }

// Everything that Ceres is handed lives in BundleSolver.
ceres::Problem::Options UnownedOptions() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

}  // namespace

void BundleSolver::Loss::Evaluate(double chi2, double out[3]) const {
  if (!is_dropped_) return huber_.Evaluate(chi2, out);
  out[0] = chi2;
  out[1] = 1;
  out[2] = 0;
}

BundleSolver::BundleSolver(const BundleOptions& options, const BundleProblem& problem)
    : options_(options), input_(problem), points_(problem.points), ceres_(UnownedOptions()) {
  poses_.reserve(problem.poses.size());
  for (const BundlePose& pose : problem.poses) poses_.emplace_back(pose.camera_from_world);
  const double scale = GateScale(Chi2());
  mono_loss_.emplace(scale * options.max_chi2_mono), stereo_loss_.emplace(scale * options.max_chi2_stereo);
  AddParameters();
  AddResiduals();
}

double BundleSolver::GateScale(const std::vector<double>& chi2) const {
  NoiseVariance noise;
  for (size_t i = 0; i < chi2.size(); ++i) noise.Add(chi2[i], IsMono(input_.observations[i]) ? 2 : 3);
  return std::min(1.0, options_.gate_margin * noise.Estimate());
}

void BundleSolver::AddParameters() {
  std::vector<char> is_pose_used(poses_.size(), 0), is_point_used(points_.size(), 0);
  for (const BundleObservation& o : input_.observations) {
    ORBSLAM_CHECK(o.pose >= 0 && o.pose < static_cast<int>(poses_.size()));
    ORBSLAM_CHECK(o.point >= 0 && o.point < static_cast<int>(points_.size()));
    is_pose_used[o.pose] = is_point_used[o.point] = 1;
  }
  for (size_t i = 0; i < points_.size(); ++i) {
    if (is_point_used[i]) ceres_.AddParameterBlock(points_[i].data(), 3);
  }
  for (size_t i = 0; i < poses_.size(); ++i) {
    if (!is_pose_used[i]) continue;
    double *const rotation = poses_[i].rotation.data(), *const translation = poses_[i].translation.data();
    ceres_.AddParameterBlock(rotation, 4, &manifold_);
    ceres_.AddParameterBlock(translation, 3);
    if (!input_.poses[i].is_fixed) continue;
    ceres_.SetParameterBlockConstant(rotation);
    ceres_.SetParameterBlockConstant(translation);
  }
}

std::vector<double> BundleSolver::DepthWeights() const {
  std::vector<double> weights(points_.size(), 1);
  if (options_.depth_correlation == 0) return weights;
  std::vector<int> num_depths(points_.size(), 0);
  for (const BundleObservation& o : input_.observations) num_depths[o.point] += !IsMono(o);
  for (size_t p = 0; p < points_.size(); ++p)
    weights[p] = 1 / (1 + std::max(0, num_depths[p] - 1) * options_.depth_correlation);
  return weights;
}

void BundleSolver::AddResiduals() {
  const std::vector<double> depth_weights = DepthWeights();
  for (const BundleObservation& o : input_.observations) {
    PoseBlock& pose = poses_[o.pose];
    costs_.emplace_back(input_.intrinsics, o, depth_weights[o.point]);
    ceres_.AddResidualBlock(&costs_.back(), IsMono(o) ? &*mono_loss_ : &*stereo_loss_, pose.rotation.data(),
                            pose.translation.data(), points_[o.point].data());
  }
}

ceres::Solver::Summary BundleSolver::Solve(int max_iterations, double function_tolerance,
                                           const std::stop_token& stop) {
  StopCallback callback(stop);
  ceres::Solver::Options options;
  options.linear_solver_type = CeresType(options_.solver);
  options.preconditioner_type = ceres::SCHUR_JACOBI;  // of the iterative one
  options.max_num_iterations = max_iterations;
  options.num_threads = options_.num_threads;
  options.function_tolerance = function_tolerance;
  options.jacobi_scaling =
      false;  // radians and metres are of like size here; saves two passes over the Jacobian
  options.callbacks.push_back(&callback);
  options.logging_type = ceres::SILENT;
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (Eigen::Vector3d& point : points_) {
    if (ceres_.HasParameterBlock(point.data())) {
      options.linear_solver_ordering->AddElementToGroup(point.data(), kPointsGroup);
    }
  }
  for (PoseBlock& pose : poses_) {
    if (!ceres_.HasParameterBlock(pose.rotation.data())) continue;
    options.linear_solver_ordering->AddElementToGroup(pose.rotation.data(), kPosesGroup);
    options.linear_solver_ordering->AddElementToGroup(pose.translation.data(), kPosesGroup);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_, &summary);
  return summary;
}

std::vector<double> BundleSolver::Chi2() const {
  std::vector<Rigid3d> poses;
  poses.reserve(poses_.size());
  for (const PoseBlock& block : poses_) poses.push_back(block.Pose());
  std::vector<double> chi2;
  chi2.reserve(input_.observations.size());
  for (const BundleObservation& o : input_.observations) {
    const Eigen::Vector3d x = poses[o.pose] * points_[o.point];
    chi2.push_back(x.z() >= NearestUsableM(o.pixel)
                       ? o.inverse_variance * input_.intrinsics.ReprojectionError(x, o.pixel).squaredNorm()
                       : std::numeric_limits<double>::infinity());
  }
  return chi2;
}

std::vector<char> BundleSolver::Classify() const {
  const std::vector<double> chi2 = Chi2();
  const double scale = GateScale(chi2);
  std::vector<char> is_inlier(chi2.size());
  for (size_t i = 0; i < chi2.size(); ++i) {
    const bool is_mono = IsMono(input_.observations[i]);
    is_inlier[i] = chi2[i] <= scale * (is_mono ? options_.max_chi2_mono : options_.max_chi2_stereo);
  }
  if (options_.max_point_error_ratio > 0) RejectUnsteadyPoints(chi2, &is_inlier);
  return is_inlier;
}

void BundleSolver::RejectUnsteadyPoints(const std::vector<double>& chi2, std::vector<char>* is_inlier) const {
  constexpr size_t kMany = 10;     // observations: their median is then known to a third
  constexpr double kLeast = 0.01;  // a tenth of a standard deviation: no corner is found better
  std::vector<std::vector<double>> of_point(points_.size());
  for (size_t i = 0; i < chi2.size(); ++i) of_point[input_.observations[i].point].push_back(chi2[i]);
  std::vector<double> medians(points_.size(), 0), all;
  for (size_t p = 0; p < of_point.size(); ++p) {
    if (of_point[p].size() < kMany) continue;
    medians[p] = MedianOf(&of_point[p]);
    all.push_back(medians[p]);
  }
  if (all.empty()) return;
  const double max_median = options_.max_point_error_ratio * std::max(kLeast, MedianOf(&all));
  for (size_t i = 0; i < chi2.size(); ++i) {
    if (medians[input_.observations[i].point] > max_median) (*is_inlier)[i] = 0;
  }
}

void BundleSolver::KeepOnly(const std::vector<char>& is_inlier) {
  for (size_t i = 0; i < is_inlier.size(); ++i) costs_[i].SetActive(is_inlier[i]);
  mono_loss_->Drop();
  stereo_loss_->Drop();
}

void BundleSolver::Export(const std::vector<char>& is_inlier, BundleProblem* problem) const {
  std::vector<char> has_inlier(points_.size(), 0);
  for (size_t i = 0; i < is_inlier.size(); ++i) has_inlier[input_.observations[i].point] |= is_inlier[i];
  for (size_t i = 0; i < points_.size(); ++i) {
    if (has_inlier[i]) problem->points[i] = points_[i];
  }
  for (size_t i = 0; i < poses_.size(); ++i) {
    if (!problem->poses[i].is_fixed) problem->poses[i].camera_from_world = poses_[i].Pose();
  }
}

}  // namespace orbslam
