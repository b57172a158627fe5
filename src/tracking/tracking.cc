// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/tracking.h"

#include <algorithm>
#include <limits>
#include <string>

#include "orbslam/tracking/keyframe_creator.h"
#include "orbslam/tracking/motion_within_frame.h"
#include "orbslam/tracking/pose_refinement.h"
#include "orbslam/util/resource_usage.h"

namespace orbslam {

Tracking::Tracking(const Sensor& sensor, const OrbExtractorOptions& orb, const TrackingOptions& options,
                   const KeyFramePolicyOptions& policy, const PlaceIndex* places, Map* map)
    : sensor_(sensor),
      options_(options),
      policy_(policy),
      map_(map),
      extractor_(orb),
      frame_tracker_(*map, sensor_, options_),
      local_map_tracker_(*map, sensor_, options_),
      relocalizer_(*map, places, sensor_, RelocalizerOptions()),
      reviser_(*map, sensor_),
      point_judge_(sensor_, map),
      doubt_(options_),
      moving_(sensor_, {}, {}) {
  if (map->Read()->num_keyframes() > 0) state_ = TrackingState::kLost;
}

FrameReport Tracking::Process(const RgbdImage& image, const MapperLoad& mapper,
                              const MaskOfFrame& mask_of_frame) {
  const CpuStopwatch stopwatch;
  FrameReport report{.id = image.id, .timestamp_s = image.timestamp_s};
  Frame frame = MakeFrame(image, mask_of_frame, &report);
  report.num_keypoints = frame.features->size();
  if (state_ == TrackingState::kNotInitialized) {
    Initialize(&frame, &report);
  } else {
    Track(image, mapper, &frame, &report);
  }
  report.state = state_;
  if (state_ == TrackingState::kOk) Remember(std::move(frame), &report);
  report.tracking_s = stopwatch.WallSeconds();
  report.tracking_cpu_s = stopwatch.CpuSeconds();
  timer_.Add("track", report.tracking_s);
  timer_.Add("track_cpu", report.tracking_cpu_s);
  report.revised = Revise(image.timestamp_s - options_.revision_delay_s);
  return report;
}

Frame Tracking::MakeFrame(const RgbdImage& image, const MaskOfFrame& mask_of_frame, FrameReport* report) {
  {
    const auto measure = timer_.Measure("extract");
    extractor_.FindCorners(image.gray);
  }
  report->moving = AskForMask(image.timestamp_s, mask_of_frame);
  OrbFeatures raw = Describe(report->moving.mask);
  doubt_.Note(report->moving, image.timestamp_s);
  has_seen_movers_ = has_seen_movers_ || report->moving.MaskedShare() > 0;
  is_mask_unused_ =
      raw.num_dropped > 0 && static_cast<int>(raw.keypoints.size()) < options_.min_unmasked_keypoints;
  if (is_mask_unused_) {
    report->moving.fail_open_reason =
        "the mask leaves only " + std::to_string(raw.keypoints.size()) + " keypoints";
    report->moving.mask = cv::Mat();
    raw = Describe(cv::Mat());
  }
  report->masked_share = report->moving.MaskedShare();
  moving_ = MovingRegion(sensor_, report->moving.mask, has_seen_movers_ ? image.depth_m : cv::Mat());
  report->num_dropped_keypoints = raw.num_dropped;
  FrameFeatures features =
      MakeFrameFeatures(raw, image.depth_m, sensor_.camera, sensor_.bounds, sensor_.depth);
  std::vector<MapPointId> points(features.size());
  Frame frame{image.id, image.timestamp_s, std::make_shared<const FrameFeatures>(std::move(features)),
              Rigid3d(), std::move(points)};
  frame.may_show_movers = has_seen_movers_;
  return frame;
}

OrbFeatures Tracking::Describe(const cv::Mat& mask) {
  const auto measure = timer_.Measure("describe");
  return extractor_.Describe(mask);
}

DynamicMask Tracking::AskForMask(double timestamp_s, const MaskOfFrame& mask_of_frame) {
  if (!mask_of_frame) return {};
  const auto measure = timer_.Measure("wait_for_mask");
  if (!last_) return mask_of_frame(Rigid3d());
  const Rigid3d predicted = motion_.Predict(last_->camera_from_world, timestamp_s - last_->timestamp_s);
  return mask_of_frame(predicted * Inverse(last_->camera_from_world));
}

void Tracking::Initialize(Frame* frame, FrameReport* report) {
  const auto num_with_depth = std::ranges::count_if(frame->features->depths_m, [](float z) { return z > 0; });
  if (num_with_depth < options_.min_initial_depth_points) return;
  InsertKeyFrame(frame, report);
  frame->pose_information.setConstant(std::numeric_limits<double>::infinity());  // the world is this camera
  report->num_matches = frame->NumPoints();
  state_ = TrackingState::kOk;
}

void Tracking::Track(const RgbdImage& image, const MapperLoad& mapper, Frame* frame, FrameReport* report) {
  const MovingView view{frame->features, image.depth_m, image.depth_delay_s};
  frame->features = AtOneInstant(view, sensor_, motion_);
  bool is_found = Locate(frame, report);
  if (map_->Read()->epoch() != epoch_) {  // the map moved under us: what was found mixes old and new
    frame->ForgetPoints();
    is_found = Locate(frame, report);
  }
  const bool was_tracking = state_ == TrackingState::kOk;
  state_ = is_found ? TrackingState::kOk : TrackingState::kLost;
  motion_.Forget();
  if (!is_found) return;
  if (was_tracking) UpdateMotion(view, frame, report);
  if (!makes_keyframes_) return;
  point_judge_.EraseCondemned();
  if (WantsKeyFrame(*frame, report->num_matches, mapper)) InsertKeyFrame(frame, report);
}

/// The motion also says better than the prediction did where the keypoints belong, and
/// these where the camera is.
void Tracking::UpdateMotion(const MovingView& view, Frame* frame, FrameReport* report) {
  const auto update = [&] {
    motion_.Update(last_->timestamp_s, last_->camera_from_world, frame->timestamp_s,
                   frame->camera_from_world);
  };
  update();
  if (view.IsOfOneInstant(sensor_)) return;
  const auto measure = timer_.Measure("motion_within_frame");
  frame->features = AtOneInstant(view, sensor_, motion_);
  report->num_matches = RefinePose(*map_, sensor_, NearPointsOf(options_, *frame), frame);
  update();
}

bool Tracking::Locate(Frame* frame, FrameReport* report) {
  FollowMapCorrections();
  return FindFirstPose(frame) && RefineOnLocalMap(frame, report);
}

/// The mapper may have moved the reference keyframe since the last frame was tied to it.
void Tracking::FollowMapCorrections() {
  const auto guard = map_->Read();
  epoch_ = guard->epoch();
  const auto reference_from_world = guard->CameraFromWorld(reference_);
  if (last_ && reference_from_world) last_->camera_from_world = last_from_reference_ * *reference_from_world;
}

bool Tracking::FindFirstPose(Frame* frame) {
  const auto measure = timer_.Measure("first_pose");
  if (state_ == TrackingState::kOk) {
    frame->camera_from_world =
        motion_.Predict(last_->camera_from_world, frame->timestamp_s - last_->timestamp_s);
    if (frame_tracker_.TrackLastFrame(*last_, frame) >= options_.min_strong_inliers) return true;
  }
  if (last_) return TakeBetterPose(frame);
  return relocalizer_.Relocalize(frame);
}

/// The prediction was poor, or there was none: the reference keyframe may know better.
bool Tracking::TakeBetterPose(Frame* frame) {
  Frame other = *frame;
  int num_inliers = frame_tracker_.TrackKeyFrame(reference_, &other);
  if (num_inliers >= options_.min_inliers && state_ == TrackingState::kOk) {
    num_inliers = std::max(num_inliers, frame_tracker_.TrackLastFrame(*last_, &other));
  }
  if (num_inliers > frame->NumPoints()) *frame = std::move(other);
  if (frame->NumPoints() >= options_.min_inliers) return true;
  return state_ == TrackingState::kLost && relocalizer_.Relocalize(frame);
}

bool Tracking::RefineOnLocalMap(Frame* frame, FrameReport* report) {
  const auto measure = timer_.Measure("local_map");
  const LocalMapTracker::Result result = local_map_tracker_.Track(moving_, frame, &counter_);
  report->num_matches = result.num_inliers;
  const bool is_lost = state_ == TrackingState::kLost;
  if (result.num_inliers < (is_lost ? options_.min_relocalized_inliers : options_.min_local_inliers))
    return false;
  if (Leaps(*frame)) return false;
  reference_ = result.reference;
  if (makes_keyframes_) JudgePoints(result, *frame);
  return true;
}

/// What looks alike in two places, or is carried about, gives poses that no camera gets to.
bool Tracking::Leaps(const Frame& frame) const {
  if (!last_) return false;
  const double elapsed_s = std::max(1 / sensor_.frame_rate_hz, frame.timestamp_s - last_->timestamp_s);
  const Rigid3d step = last_->camera_from_world * Inverse(frame.camera_from_world);
  return step.translation.norm() > options_.max_speed_mps * elapsed_s;
}

/// What is seen to move now may have done so for a while, unseen, and have bent poses and map.
void Tracking::JudgePoints(const LocalMapTracker::Result& found, const Frame& frame) {
  point_judge_.Judge(found, frame, last_ ? &*last_ : nullptr);
  if (found.near_moving.empty()) return;
  const double since_s = frame.timestamp_s - options_.max_unseen_s;
  point_judge_.Retract(found.near_moving, since_s);
  reviser_.Retract(found.near_moving, since_s);
}

bool Tracking::WantsKeyFrame(const Frame& frame, int num_inliers, const MapperLoad& mapper) const {
  if (!mapper.accepts_keyframe || is_mask_unused_ || doubt_.Holds(frame.timestamp_s)) return false;
  KeyFrameEvidence evidence = GatherKeyFrameEvidence(sensor_, *map_->Read(), frame, reference_);
  evidence.since_last_keyframe_s = frame.timestamp_s - last_keyframe_s_;
  evidence.num_erased_points = point_judge_.NumTakenFrom(reference_);
  evidence.num_inliers = num_inliers;
  evidence.is_mapper_idle = mapper.is_idle;
  return NeedsKeyFrame(evidence, policy_);
}

void Tracking::InsertKeyFrame(Frame* frame, FrameReport* report) {
  const auto measure = timer_.Measure("keyframe");
  const auto created = CreateKeyFrame(sensor_, policy_.min_depth_points, last_keyframe_, epoch_, frame, map_);
  if (!created) return;
  last_keyframe_ = reference_ = *created;
  last_keyframe_s_ = frame->timestamp_s;
  report->new_keyframe = KeyFrameReady{*created, counter_.Take()};
}

void Tracking::Remember(Frame frame, FrameReport* report) {
  const auto reference_from_world = map_->Read()->CameraFromWorld(reference_);
  last_from_reference_ = frame.camera_from_world * Inverse(*reference_from_world);
  report->world_from_camera = Inverse(frame.camera_from_world);
  report->reference = reference_;
  report->camera_from_reference = last_from_reference_;
  report->pose_information = frame.pose_information;
  if (options_.revision_delay_s > 0) {
    reviser_.Keep({frame.id, frame.timestamp_s, reference_, last_from_reference_, frame.pose_information,
                   SightingsOf(frame)});
  }
  last_ = std::move(frame);
}

std::vector<PastFrame> Tracking::ReviseRest() { return Revise(std::numeric_limits<double>::infinity()); }

std::vector<PastFrame> Tracking::Revise(double until_s) {
  const auto measure = timer_.Measure("revise");
  return reviser_.ReviseUntil(until_s);
}

}  // namespace orbslam
