// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/pipeline/dynamic_mask.h"
#include "orbslam/pipeline/past_frame.h"
#include "orbslam/util/ids.h"

namespace orbslam {

/// One RGB-D frame as it comes from the source, shared and never changed.
struct RgbdImage {
  FrameId id;
  double timestamp_s = 0;
  std::string timestamp_text;  // as it is to stand in trajectories; empty: timestamp_s with 6 decimals
  cv::Mat gray;                // CV_8UC1, raw (distorted)
  cv::Mat depth_m;             // CV_32FC1, registered to gray, metres; 0: no measurement
  double depth_delay_s = 0;    // depth was taken this much after gray
};

enum class TrackingState { kNotInitialized, kOk, kLost };
const char* Name(TrackingState state);

/// How often the frames since the last keyframe saw a map point, and found it.
struct PointStatistics {
  MapPointId point;
  int times_visible = 0, times_found = 0;
};

/// Tracking -> LocalMapping: a keyframe with its observations and depth points has been put into the map.
struct KeyFrameReady {
  KeyFrameId keyframe;
  std::vector<PointStatistics> statistics;
};

/// LocalMapping -> LoopClosing: a keyframe has been worked into the map.
struct KeyFrameMapped {
  KeyFrameId keyframe;
  uint64_t epoch = 0;  // of the map then
};

/// What Tracking knows of LocalMapping when it decides on a keyframe.
struct MapperLoad {
  bool is_idle = true;
  bool accepts_keyframe = true;  // its queue has room
};

/// How Tracking gets the mask of the frame it has: called once, when its keypoints are extracted, with the
/// camera's predicted motion since the last frame (now_from_last); may wait.
using MaskOfFrame = std::function<DynamicMask(const Rigid3d& now_from_last)>;

/// What Tracking says of a frame.
struct FrameReport {
  FrameId id;
  double timestamp_s = 0;
  TrackingState state = TrackingState::kNotInitialized;
  std::optional<Rigid3d> world_from_camera;  // only if state is kOk
  KeyFrameId reference;           // likewise; the keyframe it is best tied to, and the pose relative to it:
  Rigid3d camera_from_reference;  // what trajectories are made of, since keyframes are refined later
  Matrix6d pose_information = Matrix6d::Zero();  // UncertainPose's: as far as its matches tell
  double tracking_s = 0;          // wall time from the image to the pose
  double tracking_cpu_s = 0;      // CPU time of the calling thread in it
  int num_keypoints = 0;          // described: none on a moving object
  int num_matches = 0;            // inliers among the map points it sees
  DynamicMask moving;             // the mask that was used; its fail_open_reason also says why one was not
  double masked_share = 0;        // of the image, in [0, 1]
  int num_dropped_keypoints = 0;  // corners on moving objects, of all that were found
  std::optional<KeyFrameReady> new_keyframe;
  std::vector<PastFrame> revised;  // earlier ones, whose pose was found again: the map knows better by now
};

}  // namespace orbslam
