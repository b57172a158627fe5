// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/trajectory_log.h"

#include <algorithm>
#include <set>
#include <span>

#include "orbslam/util/check.h"
#include "orbslam/util/text.h"

namespace orbslam {
namespace {

constexpr std::ptrdiff_t kMaxWithSightings =
    20000;  // frames: 200 MB; who runs for longer needs no last adjustment

}  // namespace

void TrajectoryLog::Add(const RgbdImage& image, const FrameReport& report) {
  if (!report.world_from_camera) {
    ++stretch_;
    return;
  }
  ORBSLAM_CHECK(entries_.empty() || entries_.back().frame.id < image.id);
  entries_.push_back({{image.id,
                       image.timestamp_s,
                       report.reference,
                       report.camera_from_reference,
                       report.pose_information,
                       {}},
                      image.timestamp_text.empty() ? FormatFixed(image.timestamp_s, 6) : image.timestamp_text,
                      stretch_,
                      report.masked_share > 0});
}

void TrajectoryLog::Revise(PastFrame revised) {
  const auto entry =
      std::ranges::lower_bound(entries_, revised.id, {}, [](const Entry& e) { return e.frame.id; });
  ORBSLAM_CHECK(entry != entries_.end() && entry->frame.id == revised.id);
  entry->frame = std::move(revised);
  if (const auto index = entry - entries_.begin(); index >= kMaxWithSightings)
    entries_[index - kMaxWithSightings].frame.sightings = {};
}

std::vector<const PastFrame*> TrajectoryLog::Sample(const SampleIntervals& min_interval,
                                                    int max_count) const {
  constexpr double kJitterS = 1e-3;  // of time stamps, so that an interval of n frames is one
  std::vector<const PastFrame*> sample;
  for (const auto& [frame, text, stretch, is_masked] : entries_) {
    if (frame.sightings.empty()) continue;
    const double interval_s = is_masked ? min_interval.masked_s : min_interval.clear_s;
    if (sample.empty() || frame.timestamp_s - sample.back()->timestamp_s >= interval_s - kJitterS)
      sample.push_back(&frame);
  }
  if (std::ssize(sample) > max_count) {
    for (int i = 0; i < max_count; ++i) sample[i] = sample[i * sample.size() / max_count];
    sample.resize(max_count);
  }
  return sample;
}

void TrajectoryLog::FindPosesAgain(const Map& map, const Sensor& sensor, const std::stop_token& stop) {
  for (Entry& entry : entries_) {
    if (stop.stop_requested()) return;
    if (!entry.frame.sightings.empty()) FindPoseAgain(map, sensor, &entry.frame);
  }
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
    if (frames.contains(placed.entry->frame.id))
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
      const PastFrame& frame = entry.frame;
      const auto reference_from_world = guard->CameraFromWorld(frame.reference);
      if (!reference_from_world) continue;
      const Rigid3d world_from_camera = Inverse(frame.camera_from_reference * *reference_from_world);
      poses.push_back({frame.timestamp_s, world_from_camera, frame.pose_information});
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
