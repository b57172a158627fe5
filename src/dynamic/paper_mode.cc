// SPDX-License-Identifier: GPL-3.0-or-later
#include "paper_mode.h"

namespace orbslam {
namespace {

ReferenceOptions WithoutKeyframes(ReferenceOptions options) {
  options.max_keyframes = 0;
  return options;
}

}  // namespace

PaperMode::PaperMode(const PinholeCamera& camera, const DynamicDetectorOptions& options)
    : reducer_(camera, options.corners),
      history_(reducer_.grids().cell, WithoutKeyframes(options.references), camera.readout_s),
      motion_estimator_(reducer_.grids(), options.camera_motion),
      detector_(PaperDetectorOptions{}) {
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) rays_.emplace_back(static_cast<float>(u), static_cast<float>(v));
  rays_ = camera.Undistort(rays_);
  const cv::Point2f centre(static_cast<float>(camera.cx), static_cast<float>(camera.cy));
  for (cv::Point2f& ray : rays_)
    ray = {(ray.x - centre.x) / static_cast<float>(camera.fx),
           (ray.y - centre.y) / static_cast<float>(camera.fy)};
}

PaperFrame PaperMode::MakeCloud(const RgbdImage& image) const {
  PaperFrame cloud;
  cloud.timestamp_s = image.timestamp_s;
  for (int i = 0; i < static_cast<int>(rays_.size()); ++i) {
    const float z = image.depth_m.at<float>(i / image.depth_m.cols, i % image.depth_m.cols);
    if (!(z > 0)) continue;
    cloud.points_m.emplace_back(rays_[i].x * z, rays_[i].y * z, z);
    cloud.pixel_indices.push_back(i);
  }
  return cloud;
}

DynamicMask PaperMode::Process(const RgbdImage& image) {
  DynamicMask result;
  result.frame_id = image.id;
  const auto frame = std::make_shared<const WorkingFrame>(reducer_.Reduce(image));
  Rigid3d current_from_previous;
  if (history_.Back(1) != nullptr) {
    const CameraMotion motion = motion_estimator_.Estimate(history_, *frame, image.id.value);
    current_from_previous = motion.depth_current_from_previous;
    result.fail_open_reason = motion.failure;
    history_.Advance(Inverse(current_from_previous), Inverse(motion.color_current_from_previous));
  }
  if (!result.fail_open_reason.empty()) detector_.Reset();
  const PaperResult found = detector_.Process(MakeCloud(image), current_from_previous);
  if (!found.dynamic_pixels.empty()) {
    result.mask = cv::Mat::zeros(image.gray.size(), CV_8UC1);
    for (const int pixel : found.dynamic_pixels)
      result.mask.at<uint8_t>(pixel / image.gray.cols, pixel % image.gray.cols) = 255;
  }
  for (const PaperObject& object : found.objects)
    if (object.IsDynamic())
      result.objects.push_back({0, object.centroid_m.cast<double>(), object.velocity_mps.cast<double>(),
                                object.line_integral_ratio, 0, object.num_pixels});
  history_.Add(frame, cv::Mat1b(frame->depth_m.size(), uint8_t{0}), nullptr);
  return result;
}

}  // namespace orbslam
