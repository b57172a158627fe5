// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/trajectory_log.h"

#include <algorithm>

#include "orbslam/util/check.h"
#include "orbslam/util/text.h"

namespace orbslam {

void TrajectoryLog::Add(const RgbdImage& image, const FrameReport& report) {
  if (!report.world_from_camera) {
    ++stretch_;
    return;
  }
  ORBSLAM_CHECK(entries_.empty() || entries_.back().frame < image.id);
  entries_.push_back({image.id, image.timestamp_s,
                      image.timestamp_text.empty() ? FormatFixed(image.timestamp_s, 6) : image.timestamp_text,
                      report.reference, report.camera_from_reference, report.pose_information, stretch_});
}

void TrajectoryLog::Revise(const RevisedPose& revised) {
  const auto entry = std::ranges::lower_bound(entries_, revised.frame, {}, &Entry::frame);
  ORBSLAM_CHECK(entry != entries_.end() && entry->frame == revised.frame);
  entry->camera_from_reference = revised.camera_from_reference;
  entry->pose_information = revised.pose_information;
}

std::vector<StampedPose> TrajectoryLog::Camera(const Map& map) const {
  std::vector<const Entry*> placed;
  std::vector<UncertainPose> poses;
  {
    const auto guard = map.Read();
    for (const Entry& entry : entries_) {
      const auto reference_from_world = guard->CameraFromWorld(entry.reference);
      if (!reference_from_world) continue;
      const Rigid3d world_from_camera = Inverse(entry.camera_from_reference * *reference_from_world);
      poses.push_back({entry.timestamp_s, world_from_camera, entry.pose_information});
      placed.push_back(&entry);
    }
  }
  for (size_t begin = 0, end = 0; begin < poses.size(); begin = end) {
    while (end < poses.size() && placed[end]->stretch == placed[begin]->stretch) ++end;
    SmoothTrajectory(prior_, std::span(poses).subspan(begin, end - begin));
  }
  std::vector<StampedPose> result;
  for (size_t i = 0; i < poses.size(); ++i)
    result.push_back({placed[i]->timestamp_text, poses[i].world_from_camera});
  return result;
}

std::vector<StampedPose> TrajectoryLog::KeyFrames(const Map& map) const {
  std::vector<StampedPose> poses;
  const auto guard = map.Read();
  for (const KeyFrame& keyframe : guard->KeyFrames()) {
    const auto entry = std::ranges::lower_bound(entries_, keyframe.frame_id, {}, &Entry::frame);
    if (entry == entries_.end() || entry->frame != keyframe.frame_id) continue;
    poses.push_back({entry->timestamp_text, Inverse(keyframe.camera_from_world)});
  }
  return poses;
}

}  // namespace orbslam
