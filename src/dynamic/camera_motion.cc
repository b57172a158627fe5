// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera_motion.h"

#include <algorithm>

#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

Eigen::Vector3f Point(const GridCamera& camera, cv::Point2f pixel, float depth_m) {
  return {(pixel.x - camera.cx) / camera.fx * depth_m, (pixel.y - camera.cy) / camera.fy * depth_m, depth_m};
}

cv::Point2f Project(const GridCamera& camera, const Rigid3d& pose, const Eigen::Vector3f& x) {
  const Eigen::Vector3d q = pose * x.cast<double>();
  const double z = std::max(q.z(), 0.05);
  return {static_cast<float>(camera.fx * q.x() / z + camera.cx),
          static_cast<float>(camera.fy * q.y() / z + camera.cy)};
}

/// From the nearest point of the segment between a and b to p.
cv::Point2f FromSegment(cv::Point2f p, cv::Point2f a, cv::Point2f b) {
  const cv::Point2f along = b - a, offset = p - a;
  const float length2 = along.dot(along);
  const float share = length2 > 0 ? std::clamp(offset.dot(along) / length2, 0.f, 1.f) : 0.f;
  return offset - share * along;
}

cv::Point2f Excess(const GridCamera& camera, const Rigid3d& pose, const TrackedCorner& corner) {
  constexpr float kNear = 0.3f, kFar = 30.f;  // metres; nearer, nothing is in focus
  const auto at = [&](float depth_m) {
    return Project(camera, pose, Point(camera, corner.previous, depth_m));
  };
  if (corner.depth_m > 0) return corner.current - at(corner.depth_m);
  return FromSegment(corner.current, at(kFar), at(kNear));
}

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

std::vector<CornerMatch> RestingMatches(const GridCamera& camera, std::span<const TrackedCorner> corners) {
  std::vector<CornerMatch> matches;
  for (const TrackedCorner& corner : corners)
    if (corner.depth_m > 0 && !corner.was_moving)
      matches.push_back(
          {Point(camera, corner.previous, corner.depth_m), {corner.current.x, corner.current.y}});
  return matches;
}

void MeasureExcess(const GridCamera& camera, const Rigid3d& pose, std::vector<TrackedCorner>* corners) {
  for (TrackedCorner& corner : *corners) {
    corner.excess = Excess(camera, pose, corner);
    corner.residual_px = static_cast<float>(cv::norm(corner.excess));
  }
}

float NextInlierPx(std::span<const TrackedCorner> corners, const CameraMotionOptions& options) {
  constexpr int kMinCorners = 20;
  const std::optional<float> quartile_px = RestingResidualPx(corners, 0.25, kMinCorners);
  if (!quartile_px) return options.pose.inlier_px;
  return std::clamp(options.inlier_quartiles * *quartile_px, options.min_inlier_px, options.pose.inlier_px);
}

}  // namespace

std::optional<float> RestingResidualPx(std::span<const TrackedCorner> corners, double quantile,
                                       int min_corners) {
  std::vector<float> residuals;
  for (const TrackedCorner& corner : corners)
    if (corner.depth_m > 0 && !corner.was_moving) residuals.push_back(corner.residual_px);
  if (residuals.empty() || static_cast<int>(residuals.size()) < min_corners) return {};
  const auto rank = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(residuals.size()));
  std::nth_element(residuals.begin(), residuals.begin() + rank, residuals.end());
  return residuals[rank];
}

Rigid3d CameraMotionEstimator::Predict(double interval_s) const {
  if (previous_interval_s_ <= 0) return {};
  const double ratio = std::clamp(interval_s / previous_interval_s_, 0.0, 3.0);
  return {So3Exp(ratio * So3Log(velocity_.rotation)), ratio * velocity_.translation};
}

std::vector<TrackedCorner> CameraMotionEstimator::Follow(const ReferenceView& previous,
                                                         const WorkingFrame& current,
                                                         const Rigid3d& predicted) const {
  const WorkingFrame& last = *previous.frame;
  const std::vector<cv::Point2f> positions = SpreadCorners(last.gray, {}, options_.corners);
  std::vector<cv::Point2f> expected(positions.size());
  std::vector<TrackedCorner> corners(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    const int u = static_cast<int>(positions[i].x) / 2, v = static_cast<int>(positions[i].y) / 2;
    TrackedCorner& corner = corners[i];
    corner.previous = positions[i];
    corner.depth_m = last.depth_m(v, u);
    corner.was_moving = previous.moving(v, u) != 0;
    // Without depth, as if far away: the flow is then that of the rotation.
    expected[i] = Project(grids_.gray, predicted,
                          Point(grids_.gray, positions[i], corner.depth_m > 0 ? corner.depth_m : 3.f));
  }
  const std::vector<FlowResult> flow =
      TrackPatches(last.pyramid, current.pyramid, positions, expected, options_.flow);
  std::vector<TrackedCorner> tracked;
  for (size_t i = 0; i < flow.size(); ++i) {
    if (!flow[i].ok) continue;
    corners[i].current = flow[i].position;
    tracked.push_back(corners[i]);
  }
  return tracked;
}

std::vector<TrackedCorner> CameraMotionEstimator::FollowFrom(const ReferenceView& reference,
                                                             const WorkingFrame& current) const {
  const Rigid3d aligned = Inverse(reference.reference_from_current);
  std::vector<TrackedCorner> corners = Follow(reference, current, aligned);
  PoseFromCornersOptions refine = options_.pose;
  refine.num_draws = 0;  // the alignment is as good as any draw
  Rng rng(0);
  const PoseFromCorners pose =
      EstimatePose(grids_.gray, RestingMatches(grids_.gray, corners), {aligned}, refine, &rng);
  if (!pose.ok) return {};
  MeasureExcess(grids_.gray, pose.current_from_previous, &corners);
  return corners;
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

CameraMotion CameraMotionEstimator::Estimate(const SceneHistory& history, const WorkingFrame& current,
                                             uint64_t seed) {
  const ReferenceView& previous = *history.Back(1);
  const double interval_s = current.timestamp_s - previous.frame->timestamp_s;
  const Rigid3d predicted = Predict(interval_s);
  CameraMotion motion;
  motion.corners = Follow(previous, current, predicted);

  const PoseFromCorners from_corners = PoseOf(motion.corners, predicted, seed);
  motion.num_inliers = from_corners.num_inliers;
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

  MeasureExcess(grids_.gray, motion.color_current_from_previous, &motion.corners);
  inlier_px_ = NextInlierPx(motion.corners, options_);
  if (!from_corners.ok) motion.failure = "too few corners could be followed";
  if (motion.fit_share < options_.min_fit_share) motion.failure = "the depth does not fit the last frame's";
  velocity_ = from_corners.ok ? from_corners.current_from_previous : Inverse(icp.base_from_source);
  previous_interval_s_ = interval_s;
  return motion;
}

}  // namespace orbslam
