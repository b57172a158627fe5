// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>
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
  /// Of a frame that was added: its later pose, and what it saw.
  void Revise(PastFrame revised);
  /// Least time between frames of a sample: of those that show nothing that moves, and of those that do.
  struct SampleIntervals {
    double clear_s, masked_s;
  };
  /// Frames whose sightings are known, at such intervals from the last, and no more than that many.
  std::vector<const PastFrame*> Sample(const SampleIntervals& min_interval, int max_count) const;
  /// Looks for the pose of every frame whose sightings are known once more: after the map was adjusted.
  void FindPosesAgain(const Map& map, const Sensor& sensor, const std::stop_token& stop);

  /// One pose a tracked frame, smoothed.
  std::vector<StampedPose> Camera(const Map& map) const;
  /// Those of them that are keyframes still in the map.
  std::vector<StampedPose> KeyFrames(const Map& map) const;

  int num_poses() const { return static_cast<int>(entries_.size()); }

 private:
  struct Entry {
    PastFrame frame;
    std::string timestamp_text;
    int stretch;     // frames of one have followed one another with a pose each
    bool is_masked;  // something moved in it
  };
  struct Placed {
    const Entry* entry;
    Rigid3d world_from_camera;
  };
  std::vector<Placed> Place(const Map& map) const;

  const MotionPrior prior_;
  std::vector<Entry> entries_;  // ascending in frame.id
  int stretch_ = 0;
};

}  // namespace orbslam
