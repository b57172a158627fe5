// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/map/map_data.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/tracking/tracking_options.h"

namespace orbslam {

/// What the decision is made from.
struct KeyFrameEvidence {
  double since_last_keyframe_s = 0;
  int num_inliers = 0;           // map points tracked in this frame
  int num_shared_points = 0;     // points of the reference keyframe that another one sees too
  int num_reference_points = 0;  // all its points
  int num_erased_points = 0;     // it had more, but they moved: others can take their place
  int num_tracked_close = 0;     // close keypoints with a map point
  int num_untracked_close = 0;   // close keypoints without
  bool is_mapper_idle = true;
};

/// What frame and its reference keyframe say: the numbers of points. The rest is left as it is by default.
KeyFrameEvidence GatherKeyFrameEvidence(const Sensor& sensor, const MapData& map, const Frame& frame,
                                        KeyFrameId reference);

/// Whether the frame becomes a keyframe. (ORB-SLAM2, Mur-Artal and Tardos 2017, section III-E.)
bool NeedsKeyFrame(const KeyFrameEvidence& evidence, const KeyFramePolicyOptions& options);

}  // namespace orbslam
