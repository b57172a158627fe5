// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/tracking.h"

#include <algorithm>

#include "orbslam/tracking/keyframe_creator.h"
#include "orbslam/tracking/keyframe_policy.h"
#include "orbslam/util/resource_usage.h"

namespace orbslam {

Tracking::Tracking(const Sensor& sensor, const OrbExtractorOptions& orb, const TrackingOptions& options,
                   const KeyFramePolicyOptions& policy, Map* map)
    : sensor_(sensor),
      options_(options),
      policy_(policy),
      map_(map),
      extractor_(orb),
      frame_tracker_(*map, sensor_, options_),
      local_map_tracker_(*map, sensor_, options_) {}

FrameReport Tracking::Process(const RgbdImage& image, const MapperLoad& mapper) {
  const CpuStopwatch stopwatch;
  FrameReport report{.id = image.id, .timestamp_s = image.timestamp_s};
  Frame frame = MakeFrame(image);
  report.num_keypoints = frame.features->size();
  if (state_ == TrackingState::kNotInitialized) {
    Initialize(&frame, &report);
  } else {
    Track(mapper, &frame, &report);
  }
  report.state = state_;
  if (state_ == TrackingState::kOk) Remember(std::move(frame), &report);
  report.tracking_s = stopwatch.WallSeconds();
  report.tracking_cpu_s = stopwatch.CpuSeconds();
  timer_.Add("track", report.tracking_s);
  timer_.Add("track_cpu", report.tracking_cpu_s);
  return report;
}

Frame Tracking::MakeFrame(const RgbdImage& image) {
  OrbFeatures raw;
  {
    const auto measure = timer_.Measure("extract");
    raw = extractor_.Extract(image.gray);
  }
  auto features = std::make_shared<const FrameFeatures>(
      MakeFrameFeatures(raw, image.depth_m, cv::Mat(), sensor_.camera, sensor_.bounds, sensor_.depth));
  std::vector<MapPointId> points(features->size());
  return {image.id, image.timestamp_s, std::move(features), Rigid3d(), std::move(points)};
}

void Tracking::Initialize(Frame* frame, FrameReport* report) {
  const auto num_with_depth = std::ranges::count_if(frame->features->depths_m, [](float z) { return z > 0; });
  if (num_with_depth < options_.min_initial_depth_points) return;
  InsertKeyFrame(frame, report);
  report->num_matches = frame->NumPoints();
  state_ = TrackingState::kOk;
}

void Tracking::Track(const MapperLoad& mapper, Frame* frame, FrameReport* report) {
  FollowMapCorrections();
  const bool is_found = FindFirstPose(frame) && RefineOnLocalMap(frame, report);
  state_ = is_found ? TrackingState::kOk : TrackingState::kLost;
  if (!is_found) {
    motion_.Forget();
    return;
  }
  motion_.Update(last_->timestamp_s, last_->camera_from_world, frame->timestamp_s, frame->camera_from_world);
  if (WantsKeyFrame(*frame, report->num_matches, mapper)) InsertKeyFrame(frame, report);
}

/// The mapper may have moved the reference keyframe since the last frame was tied to it.
void Tracking::FollowMapCorrections() {
  if (const auto reference_from_world = map_->Read()->CameraFromWorld(reference_)) {
    last_->camera_from_world = last_from_reference_ * *reference_from_world;
  }
}

bool Tracking::FindFirstPose(Frame* frame) {
  const auto measure = timer_.Measure("first_pose");
  frame->camera_from_world =
      motion_.Predict(last_->camera_from_world, frame->timestamp_s - last_->timestamp_s);
  if (state_ == TrackingState::kOk && frame_tracker_.TrackLastFrame(*last_, frame) >= options_.min_inliers) return true;
  frame->camera_from_world = last_->camera_from_world;
  return frame_tracker_.TrackKeyFrame(reference_, frame) >= options_.min_inliers;
}

bool Tracking::RefineOnLocalMap(Frame* frame, FrameReport* report) {
  const auto measure = timer_.Measure("local_map");
  const LocalMapTracker::Result result = local_map_tracker_.Track(frame, &counter_);
  report->num_matches = result.num_inliers;
  if (result.num_inliers < options_.min_local_inliers) return false;
  reference_ = result.reference;
  return true;
}

bool Tracking::WantsKeyFrame(const Frame& frame, int num_inliers, const MapperLoad& mapper) const {
  if (!mapper.accepts_keyframe) return false;
  KeyFrameEvidence evidence{.since_last_keyframe_s = frame.timestamp_s - last_keyframe_s_,
                            .num_inliers = num_inliers,
                            .is_mapper_idle = mapper.is_idle};
  const double close_limit_m = sensor_.depth.CloseLimitM(sensor_.camera.fx);
  for (int i = 0; i < frame.features->size(); ++i) {
    const float depth_m = frame.features->depths_m[i];
    if (depth_m <= 0 || depth_m > close_limit_m) continue;
    ++(frame.points[i].IsValid() ? evidence.num_tracked_close : evidence.num_untracked_close);
  }
  const auto guard = map_->Read();
  evidence.num_keyframes = guard->num_keyframes();
  const int min_observations = std::min(evidence.num_keyframes, 2);
  for (const MapPointId id : guard->Find(reference_)->points) {
    if (id.IsValid() && guard->Find(id)->NumObservations() >= min_observations) ++evidence.num_reference_points;
  }
  return NeedsKeyFrame(evidence, policy_);
}

void Tracking::InsertKeyFrame(Frame* frame, FrameReport* report) {
  const auto measure = timer_.Measure("keyframe");
  last_keyframe_ = CreateKeyFrame(sensor_, policy_.min_depth_points, last_keyframe_, frame, map_);
  last_keyframe_s_ = frame->timestamp_s;
  reference_ = last_keyframe_;
  report->new_keyframe = KeyFrameReady{last_keyframe_, counter_.Take()};
}

void Tracking::Remember(Frame frame, FrameReport* report) {
  const auto reference_from_world = map_->Read()->CameraFromWorld(reference_);
  last_from_reference_ = frame.camera_from_world * Inverse(*reference_from_world);
  report->world_from_camera = Inverse(frame.camera_from_world);
  report->reference = reference_;
  report->camera_from_reference = last_from_reference_;
  last_ = std::move(frame);
}

}  // namespace orbslam
