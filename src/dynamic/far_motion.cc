// SPDX-License-Identifier: GPL-3.0-or-later
#include "far_motion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "icp.h"
#include "orbslam/geometry/depth_split.h"
#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

double SplitOfMatchesM(std::span<const CornerMatch> matches) {
  std::vector<double> depths_m;
  for (const CornerMatch& match : matches) depths_m.push_back(match.x_previous.z());
  return SplitDepthM(depths_m);
}

struct Layers {
  std::vector<CornerMatch> near, far;
};

Layers SplitAt(double split_m, std::span<const CornerMatch> matches) {
  Layers layers;
  for (const CornerMatch& match : matches)
    (match.x_previous.z() < split_m ? layers.near : layers.far).push_back(match);
  return layers;
}

Matrix6d ClockCovariance(const Rigid3d& last_step, const FarMotionOptions& options) {
  const auto sigma = [&](double of_step) { return options.least_clock + options.clock_share * of_step; };
  return IsotropicInformation(sigma(So3Log(last_step.rotation).norm()), sigma(last_step.translation.norm()))
      .inverse();
}

/// The depth camera's motion by the far cells, given the colour camera's.
std::optional<Rigid3d> AlignFar(const GridCamera& camera, const FarQuery& query, double split_m,
                                const Rigid3d& color_motion, const Matrix6d& covariance,
                                const FarMotionOptions& options) {
  IcpOptions icp;
  icp.stride = options.stride, icp.iterations = options.iterations;
  cv::Mat1b near;
  cv::compare(query.current.depth_m, split_m, near, cv::CMP_LT);
  const IcpTarget target{query.earlier.frame.get(), &query.earlier.moving, {}};
  const IcpResult result = AlignDepth(camera, query.current, &near, {&target, 1}, Inverse(color_motion),
                                      covariance.inverse(), icp);
  if (result.num_pairs < options.min_pairs || result.FitShare() < options.min_fit_share) return {};
  return Inverse(result.base_from_source);
}

/// Of the flow, sigma of one coordinate: the errors' median is 1.18 times that.
double FlowSigmaPx(const GridCamera& camera, const Rigid3d& pose, std::span<const CornerMatch> matches) {
  constexpr double kLeastPx = 0.15;  // at its best
  std::vector<double> errors_px;
  for (const CornerMatch& match : matches) errors_px.push_back(ErrorPx(camera, pose, match).norm());
  const auto middle = errors_px.begin() + static_cast<std::ptrdiff_t>(errors_px.size() / 2);
  std::nth_element(errors_px.begin(), middle, errors_px.end());
  return std::max(kLeastPx, *middle / 1.18);
}

struct FarEstimate {
  PoseFromCorners color;
  Rigid3d depth_motion;
  double sigma_px;  // of the flow
};

/// Corners draw it; the depth, which starts there, tells what they leave open; and they tell the rest.
std::optional<FarEstimate> Estimate(const WorkingGrids& grids, const FarQuery& query,
                                    const std::vector<CornerMatch>& far, double split_m,
                                    const CameraMotionOptions& options, Rng* rng) {
  const PoseFromCorners drawn = EstimatePose(grids.gray, far, query.candidates, options.pose, rng);
  if (!drawn.ok) return {};
  PoseFromCornersOptions refining = options.pose;
  refining.num_draws = 0;
  refining.sigma_px = FlowSigmaPx(grids.gray, drawn.current_from_previous, far);
  const double noise = refining.sigma_px / options.pose.sigma_px;
  const Matrix6d clock = ClockCovariance(query.last_step, options.far);
  const std::optional<Rigid3d> aligned =
      AlignFar(grids.cell, query, split_m, drawn.current_from_previous,
               noise * noise * drawn.information.inverse() + clock, options.far);
  if (!aligned) return {};
  const PosePrior prior{*aligned, clock.inverse()};
  const PoseFromCorners color = EstimatePose(grids.gray, far, {*aligned}, refining, rng, &prior);
  if (!color.ok) return {};
  return FarEstimate{color, *aligned, refining.sigma_px};
}

/// Whether a corner is where it would not be if it rested, whatever errors pose and flow may have.
bool Deviates(const GridCamera& camera, const FarEstimate& far, const CornerMatch& match,
              const FarMotionOptions& options) {
  const Rigid3d& pose = far.color.current_from_previous;
  const Eigen::Vector2d error = ErrorPx(camera, pose, match);
  if (error.norm() < options.min_deviation_px) return false;
  const Eigen::Matrix<double, 2, 6> jacobian = PixelFromMotion(camera, pose, match);
  const Eigen::Matrix2d covariance = jacobian * far.color.information.inverse() * jacobian.transpose() +
                                     far.sigma_px * far.sigma_px * Eigen::Matrix2d::Identity();
  return error.dot(covariance.inverse() * error) > options.min_sigmas * options.min_sigmas;
}

}  // namespace

std::optional<FarMotion> ContradictedFarMotion(const WorkingGrids& grids, const FarQuery& query,
                                               const CameraMotionOptions& options, Rng* rng) {
  const double split_m = SplitOfMatchesM(query.matches);
  const Layers layers = SplitAt(split_m, query.matches);
  const auto num_near = std::ssize(layers.near), num_far = std::ssize(layers.far);
  if (num_near < options.far.min_near || num_far < options.far.min_far) return {};
  const auto far = Estimate(grids, query, layers.far, split_m, options, rng);
  if (!far) return {};
  const int num_resting = far->color.num_inliers;
  const auto num_deviating = std::ranges::count_if(
      layers.near, [&](const CornerMatch& match) { return Deviates(grids.gray, *far, match, options.far); });
  const bool far_is_one = num_resting >= options.far.min_far &&
                          num_resting >= options.far.min_far_share * static_cast<double>(num_far);
  if (!far_is_one || 2 * num_deviating < num_near || num_deviating > num_resting) return {};
  return FarMotion{far->color.current_from_previous, far->depth_motion, split_m};
}

std::optional<FarMotion> FindFarMotion(const WorkingGrids& grids, const FarQuery& query, double split_m,
                                       const CameraMotionOptions& options, Rng* rng) {
  const auto far = Estimate(grids, query, SplitAt(split_m, query.matches).far, split_m, options, rng);
  if (!far) return {};
  return FarMotion{far->color.current_from_previous, far->depth_motion, split_m};
}

}  // namespace orbslam
