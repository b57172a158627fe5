// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/system.h"

namespace orbslam {

System::System(const Settings& settings)
    : sensor_(settings.camera, settings.depth, settings.orb, settings.fps),
      map_(sensor_.pyramid),
      tracking_(sensor_, settings.orb, TrackingOptions(), KeyFramePolicyOptions(), &map_) {}

FrameReport System::TrackRgbd(RgbdImage image) {
  image.id = FrameId(num_frames_++);
  FrameReport report = tracking_.Process(image);
  trajectory_.Add(image, report);
  return report;
}

void System::Shutdown() {}

Status System::SaveTrajectory(const std::string& path) const {
  return WriteTrajectory(path, trajectory_.Camera(map_));
}

Status System::SaveKeyFrameTrajectory(const std::string& path) const {
  return WriteTrajectory(path, trajectory_.KeyFrames(map_));
}

System::Counts System::counts() const {
  const auto guard = map_.Read();
  return {.frames = static_cast<int>(num_frames_),
          .tracked = trajectory_.num_poses(),
          .keyframes = guard->num_keyframes(),
          .map_points = guard->num_points()};
}

}  // namespace orbslam
