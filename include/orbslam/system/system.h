// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orbslam/io/settings.h"
#include "orbslam/map/map.h"
#include "orbslam/pipeline/messages.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/system/trajectory_log.h"
#include "orbslam/tracking/tracking.h"
#include "orbslam/util/result.h"
#include "orbslam/util/stage_timer.h"

namespace orbslam {

/// The whole SLAM system: give it RGB-D frames in order of time, get camera poses, save trajectories.
///
///   orbslam::System slam(*orbslam::ReadSettings("TUM1.yaml", &warnings));
///   orbslam::FrameReport report = slam.TrackRgbd(image);   // report.world_from_camera, report.state
///   slam.Shutdown();
///   slam.SaveTrajectory("CameraTrajectory.txt");
///
/// World frame: that of the first tracked camera. To be used from one thread.
class System {
 public:
  explicit System(const Settings& settings);

  /// Tracks the next frame: gray CV_8UC1 and depth_m CV_32FC1 of the settings' size. Its id is set here.
  FrameReport TrackRgbd(RgbdImage image);

  /// Lets everything under way finish. Trajectories can be saved before and after; tracking ends.
  void Shutdown();

  /// All tracked frames, with the latest estimate of each. TUM format.
  Status SaveTrajectory(const std::string& path) const;
  /// All keyframes. TUM format.
  Status SaveKeyFrameTrajectory(const std::string& path) const;

  struct Counts {
    int frames = 0;          // given
    int tracked = 0;         // with a pose
    int keyframes = 0;       // in the map now
    int map_points = 0;
  };
  Counts counts() const;
  std::map<std::string, StageTimer::Statistics> timings() const { return tracking_.timer().Summarize(); }
  const Map& map() const { return map_; }

 private:
  const Sensor sensor_;
  Map map_;
  Tracking tracking_;
  TrajectoryLog trajectory_;
  uint32_t num_frames_ = 0;
};

}  // namespace orbslam
