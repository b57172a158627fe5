// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "orbslam/features/frame_features.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/tracking/motion_model.h"

namespace orbslam {

/// What a moving camera saw, at more than one instant.
struct MovingView {
  std::shared_ptr<const FrameFeatures> features;  // as the images show them
  cv::Mat depth_m;                                // RgbdImage's
  double depth_delay_s = 0;                       // likewise
  /// Neither a rolling shutter nor depth of another time: there is nothing to undo.
  bool IsOfOneInstant(const Sensor& sensor) const;
};

/// Keypoints as they would have been seen had every row been exposed together with the middle one, and had
/// depth been measured then.
///
/// A rolling shutter exposes row after row, and most cameras measure depth some milliseconds before or after,
/// so that a moving camera sees each from a pose of its own. The motion of this frame, constant meanwhile,
/// says where in the depth image a keypoint's point was, and how much nearer then. Each keypoint is carried
/// on its ray, at its depth, to the pose of the middle row: pixels, depths and right coordinates change, the
/// rest stays (Forssen and Ringaby, "Rectifying rolling shutter video from hand-held devices", CVPR 2010,
/// with depth). A keypoint without depth moves as if it had the median of the others. The row is that of the
/// raw, distorted image.
///
/// Returns the view's features themselves while the motion is unknown, or where there is nothing to undo.
std::shared_ptr<const FrameFeatures> AtOneInstant(const MovingView& view, const Sensor& sensor,
                                                  const MotionModel& motion);

}  // namespace orbslam
