// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "orbslam/features/frame_features.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/tracking/motion_model.h"

namespace orbslam {

/// Keypoints as they would have been seen had every row been exposed together with the middle one.
///
/// A rolling shutter exposes row after row, so that a moving camera sees each from a pose of its own. Under
/// the motion of this frame, constant during its exposure, each keypoint is carried on its ray, at its depth,
/// to the pose of the middle row: pixels, depths and right coordinates change, the rest stays (Forssen and
/// Ringaby, "Rectifying rolling shutter video from hand-held devices", CVPR 2010, with depth). A keypoint
/// without depth moves as if it had the median of the others. The row is that of the raw, distorted image.
///
/// Returns `rolled` itself while the motion is unknown, or without a rolling shutter (camera.readout_s is 0).
std::shared_ptr<const FrameFeatures> UndoRollingShutter(std::shared_ptr<const FrameFeatures> rolled,
                                                        const Sensor& sensor, const MotionModel& motion);

}  // namespace orbslam
