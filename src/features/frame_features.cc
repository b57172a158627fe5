// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/frame_features.h"

#include <cmath>

#include "orbslam/features/corner_depth.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

cv::Point RoundedPixel(const OrbKeypoint& keypoint) {
  return {static_cast<int>(std::lround(keypoint.u)), static_cast<int>(std::lround(keypoint.v))};
}

void ReadDepths(const std::vector<cv::Point>& raw_pixels, const cv::Mat& depth_m,
                const DepthModel& depth_model, FrameFeatures* features) {
  for (size_t i = 0; i < raw_pixels.size(); ++i) {
    const float depth = CornerDepthM(depth_m, raw_pixels[i], depth_model);
    const bool valid = depth > 0.0f;
    features->depths_m.push_back(depth);
    features->right_u.push_back(
        valid ? static_cast<float>(depth_model.RightCoordinate(features->pixels[i].x, depth)) : -1.0f);
  }
}

}  // namespace

FrameFeatures MakeFrameFeatures(const OrbFeatures& raw, const cv::Mat& depth_m, const PinholeCamera& camera,
                                const ImageBounds& bounds, const DepthModel& depth_model) {
  ORBSLAM_CHECK(depth_m.empty() || depth_m.type() == CV_32FC1);
  const size_t size = raw.keypoints.size();
  FrameFeatures features;
  std::vector<cv::Point> raw_pixels;
  for (auto* floats : {&features.angles_deg, &features.depths_m, &features.right_u}) floats->reserve(size);
  features.pixels.reserve(size);
  features.levels.reserve(size);
  raw_pixels.reserve(size);
  for (const OrbKeypoint& keypoint : raw.keypoints) {
    features.pixels.emplace_back(keypoint.u, keypoint.v);
    features.angles_deg.push_back(keypoint.angle_deg);
    features.levels.push_back(keypoint.level);
    raw_pixels.push_back(RoundedPixel(keypoint));
  }
  features.descriptors = raw.descriptors;
  features.pixels = camera.Undistort(features.pixels);
  ReadDepths(raw_pixels, depth_m, depth_model, &features);
  features.grid = FeatureGrid(features.pixels, bounds);
  return features;
}

}  // namespace orbslam
