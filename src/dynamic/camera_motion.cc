// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera_motion.h"

#include <algorithm>

#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

/// What the colour motion says of the depth motion: its own covariance, and that of the time between the
/// images.
Eigen::Matrix<double, 6, 6> DepthPriorInformation(const PoseFromCorners& color, const IcpOptions& options) {
  const Eigen::Matrix<double, 6, 6> of_time =
      IsotropicInformation(options.prior_rotation_rad, options.prior_translation_m);
  if (!color.ok) return 0.01 * of_time;  // a guess: ten times less certain
  return (color.information.inverse() + of_time.inverse()).inverse();
}

/// Whether the depth camera can have moved so while the colour camera moved otherwise.
bool IsPlausible(const Rigid3d& depth, const Rigid3d& color, const CameraMotionOptions& options) {
  const auto angle = [](const Rigid3d& motion) { return So3Log(motion.rotation).norm(); };
  const Rigid3d difference = depth * Inverse(color);
  return difference.translation.norm() < options.max_depth_sigmas * options.icp.prior_translation_m +
                                             options.max_clock_share * color.translation.norm() &&
         angle(difference) < options.max_depth_sigmas * options.icp.prior_rotation_rad +
                                 options.max_clock_share * angle(color);
}

/// Corners can be misled too: a thing that moves before a wall parallel to the image looks to them like a
/// turn of the camera. Then the wall's depth does not fit their motion.
bool FitsDepth(const GridCamera& cell_camera, const WorkingFrame& current, std::span<const IcpTarget> targets,
               const Rigid3d& current_from_previous, double best_fit_share, IcpOptions options) {
  constexpr double kAsWell = 0.9;
  options.iterations = 1;  // the share is that before the step
  const IcpResult at_pose = AlignDepth(cell_camera, current, nullptr, targets, Inverse(current_from_previous),
                                       IsotropicInformation(1, 1), options);
  return at_pose.FitShare() > kAsWell * best_fit_share;
}

/// How far apart, at most, the two put a point of the room (m).
double Distance(const Rigid3d& a, const Rigid3d& b) {
  constexpr double kRoomM = 3;
  const Rigid3d difference = a * Inverse(b);
  return difference.translation.norm() + kRoomM * So3Log(difference.rotation).norm();
}

float NextInlierPx(std::span<const TrackedCorner> corners, const CameraMotionOptions& options) {
  constexpr int kMinCorners = 20;
  const std::optional<float> quartile_px = RestingResidualPx(corners, 0.25, kMinCorners);
  if (!quartile_px) return options.pose.inlier_px;
  return std::clamp(options.inlier_quartiles * *quartile_px, options.min_inlier_px, options.pose.inlier_px);
}

}  // namespace

Rigid3d CameraMotionEstimator::Predict(double interval_s) const {
  if (previous_interval_s_ <= 0) return {};
  const double ratio = std::clamp(interval_s / previous_interval_s_, 0.0, 3.0);
  return {So3Exp(ratio * So3Log(velocity_.rotation)), ratio * velocity_.translation};
}

std::optional<FarMotion> CameraMotionEstimator::FarMotionSince(const ReferenceView& older,
                                                               const WorkingFrame& current,
                                                               std::span<const CornerMatch> matches,
                                                               uint64_t seed) const {
  if (!options_.far.use_far_motion) return {};
  Rng rng(seed, 2, 0xE60);
  const std::vector<Rigid3d> carried{Inverse(older.color_reference_from_current),
                                     Inverse(older.reference_from_current)};
  return ContradictedFarMotion(grids_, {older, current, matches, carried, velocity_}, options_, &rng);
}

void CameraMotionEstimator::FollowFar(const ReferenceView& last, const WorkingFrame& current, double split_m,
                                      uint64_t seed, CameraMotion* motion) {
  Rng rng(seed, 3, 0xE60);
  const std::vector<CornerMatch> matches = RestingMatches(grids_.gray, motion->corners);
  const std::vector<Rigid3d> candidates{motion->color_current_from_previous, Rigid3d()};
  const auto far =
      FindFarMotion(grids_, {last, current, matches, candidates, velocity_}, split_m, options_, &rng);
  if (!far) return;
  motion->color_current_from_previous = velocity_ = far->color_current_from_earlier;
  motion->depth_current_from_previous = far->depth_current_from_earlier;
  MeasureExcess(grids_.gray, motion->color_current_from_previous, &motion->corners);
  inlier_px_ = NextInlierPx(motion->corners, options_);
}

/// Draws find the room where somebody who set off has bent what is carried, but where a thing fills the
/// picture they prefer that: of the two poses the one that is nearer to the depth's own.
PoseFromCorners CameraMotionEstimator::PoseSince(const ReferenceView& older,
                                                 const std::vector<CornerMatch>& matches,
                                                 uint64_t seed) const {
  const Rigid3d aligned = Inverse(older.reference_from_current);
  const std::vector<Rigid3d> candidates{Inverse(older.color_reference_from_current), aligned};
  PoseFromCornersOptions without_draws = options_.pose;
  without_draws.num_draws = 0;
  Rng rng(seed, 1, 0xE60);
  const PoseFromCorners refined = EstimatePose(grids_.gray, matches, candidates, without_draws, &rng);
  PoseFromCornersOptions all_draws = options_.pose;
  all_draws.max_missed = 0;  // where two things are about as large, the better of them is found late
  const PoseFromCorners drawn = EstimatePose(grids_.gray, matches, candidates, all_draws, &rng);
  const auto from_depth = [&](const PoseFromCorners& pose) {
    return Distance(pose.current_from_previous, aligned);
  };
  return drawn.ok && (!refined.ok || from_depth(drawn) < from_depth(refined)) ? drawn : refined;
}

OlderCorners CameraMotionEstimator::FollowFrom(const ReferenceView& older, const ReferenceView& last,
                                               const WorkingFrame& current, uint64_t seed) const {
  const Rigid3d carried = Inverse(older.color_reference_from_current);
  std::vector<TrackedCorner> corners =
      FollowCorners(grids_, older, current, carried, Baseline::kLong, options_.flow);
  const cv::Rect inside({0, 0}, last.moving.size());
  for (TrackedCorner& corner : corners)
    if (const cv::Point cell = CellOf(corner); inside.contains(cell) && last.moving(cell) != 0)
      corner.was_moving = true;
  const std::vector<CornerMatch> matches = RestingMatches(grids_.gray, corners);
  OlderCorners result;
  result.far = FarMotionSince(older, current, matches, seed);
  if (result.far) {
    result.current_from_older = result.far->color_current_from_earlier;
  } else {
    const PoseFromCorners pose = PoseSince(older, matches, seed);
    if (!pose.ok) return {};
    result.current_from_older = pose.current_from_previous;
  }
  MeasureExcess(grids_.gray, *result.current_from_older, &corners);
  result.corners = std::move(corners);
  return result;
}

PoseFromCorners CameraMotionEstimator::PoseOf(std::span<const TrackedCorner> corners,
                                              const Rigid3d& predicted, uint64_t seed) const {
  const std::vector<CornerMatch> matches = RestingMatches(grids_.gray, corners);
  PoseFromCornersOptions options = options_.pose;
  options.inlier_px = inlier_px_;
  Rng rng(seed, 0, 0xE60);
  PoseFromCorners pose = EstimatePose(grids_.gray, matches, {predicted, Rigid3d()}, options, &rng);
  if (pose.ok || inlier_px_ == options_.pose.inlier_px) return pose;
  // It may have begun to blur.
  return EstimatePose(grids_.gray, matches, {predicted, Rigid3d()}, options_.pose, &rng);
}

/// Where somebody leaves little of the room in view, too few corners for a pose of their own may still
/// confirm the depth's.
PoseFromCorners CameraMotionEstimator::PoseOfFew(std::span<const TrackedCorner> corners,
                                                 const Rigid3d& depth_motion, uint64_t seed) const {
  PoseFromCornersOptions options = options_.pose;
  options.min_inliers = options_.min_inliers_with_depth;
  options.num_draws = 0;
  const PosePrior prior{
      depth_motion, IsotropicInformation(options_.icp.prior_rotation_rad, options_.icp.prior_translation_m)};
  Rng rng(seed, 4, 0xE60);
  return EstimatePose(grids_.gray, RestingMatches(grids_.gray, corners), {depth_motion}, options, &rng,
                      &prior);
}

CameraMotion CameraMotionEstimator::Estimate(const SceneHistory& history, const WorkingFrame& current,
                                             uint64_t seed) {
  const ReferenceView& previous = *history.Back(1);
  const double interval_s = current.timestamp_s - previous.frame->timestamp_s;
  const Rigid3d predicted = Predict(interval_s);
  CameraMotion motion;
  motion.corners = FollowCorners(grids_, previous, current, predicted, Baseline::kShort, options_.flow);

  PoseFromCorners from_corners = PoseOf(motion.corners, predicted, seed);
  motion.color_current_from_previous = from_corners.ok ? from_corners.current_from_previous : predicted;

  std::vector<IcpTarget> targets{{previous.frame.get(), &previous.moving, {}}};
  if (const ReferenceView* far = history.Back(options_.far_target))
    targets.push_back({far->frame.get(), &far->moving, far->reference_from_current});
  const IcpResult icp =
      AlignDepth(grids_.cell, current, nullptr, targets, Inverse(motion.color_current_from_previous),
                 DepthPriorInformation(from_corners, options_.icp), options_.icp);
  motion.fit_share = icp.FitShare();
  motion.depth_current_from_previous = Inverse(icp.base_from_source);
  motion.is_depth_misled =
      from_corners.ok &&
      !IsPlausible(motion.depth_current_from_previous, motion.color_current_from_previous, options_) &&
      FitsDepth(grids_.cell, current, targets, motion.color_current_from_previous, motion.fit_share,
                options_.icp);
  if (motion.is_depth_misled) motion.depth_current_from_previous = motion.color_current_from_previous;
  if (!from_corners.ok && motion.fit_share >= options_.min_fit_share) {
    from_corners = PoseOfFew(motion.corners, motion.depth_current_from_previous, seed);
    if (from_corners.ok) motion.color_current_from_previous = from_corners.current_from_previous;
  }
  motion.num_inliers = from_corners.num_inliers;
  MeasureExcess(grids_.gray, motion.color_current_from_previous, &motion.corners);
  inlier_px_ = NextInlierPx(motion.corners, options_);
  if (!from_corners.ok) motion.failure = "too few corners could be followed";
  if (motion.fit_share < options_.min_fit_share) motion.failure = "the depth does not fit the last frame's";
  velocity_ = from_corners.ok ? from_corners.current_from_previous : Inverse(icp.base_from_source);
  previous_interval_s_ = interval_s;
  return motion;
}

}  // namespace orbslam
