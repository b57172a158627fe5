// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "camera_motion.h"
#include "orbslam/dynamic/paper_detector.h"
#include "orbslam/pipeline/dynamic_mask.h"
#include "scene_history.h"

namespace orbslam {

/// Mode kPaper of DynamicDetector: the published method on the full cloud, with our ego-motion.
class PaperMode {
 public:
  PaperMode(const PinholeCamera& camera, const DynamicDetectorOptions& options);

  DynamicMask Process(const RgbdImage& image);

 private:
  PaperFrame MakeCloud(const RgbdImage& image) const;

  FrameReducer reducer_;
  SceneHistory history_;
  CameraMotionEstimator motion_estimator_;
  PaperDetector detector_;
  std::vector<cv::Point2f> rays_;  // x / z, y / z of each raw pixel
};

}  // namespace orbslam
