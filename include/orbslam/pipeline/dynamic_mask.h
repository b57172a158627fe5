// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "orbslam/util/ids.h"

namespace orbslam {

/// A thing that moves, as the DynamicDetector saw it in one frame.
struct DynamicObject {
  int id = 0;                                            // the same from frame to frame while it is followed
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  // camera frame of the depth image
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  // camera axes, the camera's own motion taken off
  double line_integral_ratio = 0;                          // motion histogram: delta / tau; dynamic above 1
  double log_odds = 0;                                     // of all evidence together
  int num_pixels = 0;                                      // of the image, covered by it
};

/// DynamicDetector -> Tracking: which pixels of a frame belong to moving objects.
struct DynamicMask {
  FrameId frame_id;
  cv::Mat mask;  // CV_8UC1 of the raw image's size, non-zero: moving; empty: nothing is
  std::vector<DynamicObject> objects;
  std::string
      fail_open_reason;  // why nothing is masked although something may move; empty: the mask is meant
  double latency_s = 0;  // wall time from the frame's arrival at the detector

  /// Share of the image's pixels that are masked, in [0, 1].
  double MaskedShare() const {
    return mask.empty() ? 0.0
                        : static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
  }
};

}  // namespace orbslam
