// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/map/map.h"
#include "orbslam/optimization/pose_optimizer.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/tracking/tracking_options.h"

namespace orbslam {

/// The frame's matches as an optimisation problem, and the keypoint of each observation.
struct FramePoseProblem {
  PoseProblem problem;
  std::vector<int> keypoints;
};
/// Follows fused points and forgets erased ones, in the frame too.
FramePoseProblem GatherPoseProblem(const Map& map, const Sensor& sensor, Frame* frame);

/// Whether what is near may contradict what is far (FarPose): not in a scene where nothing has ever moved.
enum class NearPoints { kTrusted, kDoubted };
inline NearPoints NearPointsOf(const TrackingOptions& options, const Frame& frame) {
  return frame.may_show_movers && options.doubt_near_points ? NearPoints::kDoubted : NearPoints::kTrusted;
}

/// Optimises the frame's pose over the map points its keypoints show, and forgets the matches that turn out
/// to be outliers or whose point is gone. Says how well the pose is known then. Returns the number of matches
/// left.
int RefinePose(const Map& map, const Sensor& sensor, NearPoints near, Frame* frame);

/// The same without a prior and among many wrong matches: P3P with RANSAC, then refinement over what agrees.
/// 0: no pose was found.
int EstimatePose(const Map& map, const Sensor& sensor, Frame* frame);

}  // namespace orbslam
