// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orbslam/io/trajectory.h"
#include "orbslam/map/map.h"
#include "orbslam/optimization/trajectory_smoother.h"
#include "orbslam/pipeline/messages.h"

namespace orbslam {

/// Remembers every tracked frame relative to a keyframe, so that trajectories benefit from all that the map
/// learned later; and what is known of how a camera moves makes them smooth. Poses are world_from_camera at
/// the colour image's time stamp.
class TrajectoryLog {
 public:
  explicit TrajectoryLog(const MotionPrior& prior) : prior_(prior) {}

  /// Frames without a pose are not kept, but interrupt the motion.
  void Add(const RgbdImage& image, const FrameReport& report);
  /// Of a frame that was added.
  void Revise(const RevisedPose& revised);

  /// One pose a tracked frame, smoothed.
  std::vector<StampedPose> Camera(const Map& map) const;
  /// Those of them that are keyframes still in the map.
  std::vector<StampedPose> KeyFrames(const Map& map) const;

  int num_poses() const { return static_cast<int>(entries_.size()); }

 private:
  struct Entry {
    FrameId frame;
    double timestamp_s;
    std::string timestamp_text;
    KeyFrameId reference;
    Rigid3d camera_from_reference;
    Matrix6d pose_information;
    int stretch;  // frames of one have followed one another with a pose each
  };
  struct Placed {
    const Entry* entry;
    Rigid3d world_from_camera;
  };
  std::vector<Placed> Place(const Map& map) const;

  const MotionPrior prior_;
  std::vector<Entry> entries_;  // ascending in frame
  int stretch_ = 0;
};

}  // namespace orbslam
