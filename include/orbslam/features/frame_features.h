// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "orbslam/camera/depth_model.h"
#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/features/feature_grid.h"
#include "orbslam/features/orb_extractor.h"
#include "orbslam/features/scale_pyramid.h"

namespace orbslam {

/// What one RGB-D image says, computed once and never changed: shared by frames, keyframes and matchers without
/// any lock. All vectors have one entry a keypoint.
struct FrameFeatures {
  std::vector<cv::Point2f> pixels;      // undistorted, px
  std::vector<float> angles_deg;        // [0, 360)
  std::vector<int> levels;
  std::vector<Descriptor> descriptors;
  std::vector<float> depths_m;          // <= 0: no depth
  std::vector<float> right_u;           // px, column in the virtual right camera; < 0: no depth
  FeatureGrid grid;

  int size() const { return static_cast<int>(pixels.size()); }
  bool HasDepth(int i) const { return depths_m[i] > 0; }
};

/// Undistorts the keypoints and reads their depth (metres, CV_32FC1, same size as the raw image, <= 0 or nan: none)
/// at their raw pixels.
FrameFeatures MakeFrameFeatures(const OrbFeatures& raw, const cv::Mat& depth_m, const PinholeCamera& camera,
                                const ImageBounds& bounds, const DepthModel& depth_model);

}  // namespace orbslam
