// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/trajectory_log.h"

#include <algorithm>
#include <set>
#include <span>

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
  std::vector<StampedPose> poses;
  for (const Placed& placed : Place(map))
    poses.push_back({placed.entry->timestamp_text, placed.world_from_camera});
  return poses;
}

std::vector<StampedPose> TrajectoryLog::KeyFrames(const Map& map) const {
  std::set<FrameId> frames;
  {
    const auto guard = map.Read();
    for (const KeyFrame& keyframe : guard->KeyFrames()) frames.insert(keyframe.frame_id);
  }
  std::vector<StampedPose> poses;
  for (const Placed& placed : Place(map)) {
    if (frames.contains(placed.entry->frame))
      poses.push_back({placed.entry->timestamp_text, placed.world_from_camera});
  }
  return poses;
}

std::vector<TrajectoryLog::Placed> TrajectoryLog::Place(const Map& map) const {
  std::vector<Placed> all;
  std::vector<UncertainPose> poses;
  {
    const auto guard = map.Read();
    for (const Entry& entry : entries_) {
      const auto reference_from_world = guard->CameraFromWorld(entry.reference);
      if (!reference_from_world) continue;
      const Rigid3d world_from_camera = Inverse(entry.camera_from_reference * *reference_from_world);
      poses.push_back({entry.timestamp_s, world_from_camera, entry.pose_information});
      all.push_back({&entry, Rigid3d()});
    }
  }
  for (size_t begin = 0, end = 0; begin < poses.size(); begin = end) {
    while (end < poses.size() && all[end].entry->stretch == all[begin].entry->stretch) ++end;
    SmoothTrajectory(prior_, std::span(poses).subspan(begin, end - begin));
  }
  for (size_t i = 0; i < all.size(); ++i) all[i].world_from_camera = poses[i].world_from_camera;
  return all;
}

}  // namespace orbslam
