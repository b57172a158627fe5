// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orbslam/features/orb_extractor.h"
#include "orbslam/map/map.h"
#include "orbslam/pipeline/messages.h"
#include "orbslam/tracking/frame_tracker.h"
#include "orbslam/tracking/keyframe_policy.h"
#include "orbslam/tracking/local_map_tracker.h"
#include "orbslam/tracking/mask_doubt.h"
#include "orbslam/tracking/motion_model.h"
#include "orbslam/tracking/motion_within_frame.h"
#include "orbslam/tracking/moving_region.h"
#include "orbslam/tracking/point_counter.h"
#include "orbslam/tracking/point_judge.h"
#include "orbslam/tracking/pose_reviser.h"
#include "orbslam/tracking/relocalizer.h"
#include "orbslam/tracking/tracking_options.h"
#include "orbslam/util/stage_timer.h"

namespace orbslam {

/// Where is the camera? One frame in, one pose out; makes keyframes. Knows nothing of threads: whoever calls
/// Process does so from one thread at a time. (ORB-SLAM2, Mur-Artal and Tardos, T-RO 2017, section III.)
class Tracking {
 public:
  /// places: for relocalisation; nullptr: no vocabulary, keyframes are tried in turn. A map that is not empty
  /// is known already: the first frame is looked for in it.
  Tracking(const Sensor& sensor, const OrbExtractorOptions& orb, const TrackingOptions& options,
           const KeyFramePolicyOptions& policy, const PlaceIndex* places, Map* map);

  /// mask_of_frame: asked for the frame's mask; empty: nothing moves.
  FrameReport Process(const RgbdImage& image, const MapperLoad& mapper = {},
                      const MaskOfFrame& mask_of_frame = {});

  /// In localisation mode no keyframes are made: the map stays as it is.
  void SetLocalizationMode(bool is_on) { makes_keyframes_ = !is_on; }

  /// The later poses of all frames that have none yet: for the end.
  std::vector<PastFrame> ReviseRest();

  /// Time spent in each step, seconds.
  const StageTimer& timer() const { return timer_; }

 private:
  Frame MakeFrame(const RgbdImage& image, const MaskOfFrame& mask_of_frame, FrameReport* report);
  OrbFeatures Describe(const cv::Mat& mask);
  DynamicMask AskForMask(double timestamp_s, const MaskOfFrame& mask_of_frame);
  void Initialize(Frame* frame, FrameReport* report);
  void Track(const RgbdImage& image, const MapperLoad& mapper, Frame* frame, FrameReport* report);
  void UpdateMotion(const MovingView& view, Frame* frame, FrameReport* report);
  bool Locate(Frame* frame, FrameReport* report);
  bool FindFirstPose(Frame* frame);
  bool TakeBetterPose(Frame* frame);
  bool RefineOnLocalMap(Frame* frame, FrameReport* report);
  bool Leaps(const Frame& frame) const;
  void JudgePoints(const LocalMapTracker::Result& found, const Frame& frame);
  void FollowMapCorrections();
  bool WantsKeyFrame(const Frame& frame, int num_inliers, const MapperLoad& mapper) const;
  void InsertKeyFrame(Frame* frame, FrameReport* report);
  void Remember(Frame frame, FrameReport* report);
  std::vector<PastFrame> Revise(double until_s);

  const Sensor& sensor_;
  const TrackingOptions options_;
  const KeyFramePolicyOptions policy_;
  Map* map_;
  OrbExtractor extractor_;
  FrameTracker frame_tracker_;
  LocalMapTracker local_map_tracker_;
  Relocalizer relocalizer_;
  MotionModel motion_;
  PointCounter counter_;
  PoseReviser reviser_;
  PointJudge point_judge_;
  MaskDoubt doubt_;
  StageTimer timer_;

  TrackingState state_ = TrackingState::kNotInitialized;
  bool makes_keyframes_ = true;
  MovingRegion moving_;           // of the present frame
  bool has_seen_movers_ = false;  // ever: until then everything is taken to rest, as without a detector
  bool is_mask_unused_ = false;   // the present frame may show moving objects as if they were static
  uint64_t epoch_ = 0;            // of the map, when the present frame was begun
  std::optional<Frame> last_;     // the last frame that was tracked
  KeyFrameId reference_;          // the keyframe that shares most points with it
  Rigid3d last_from_reference_;
  double last_keyframe_s_ = 0;
  KeyFrameId last_keyframe_;
};

}  // namespace orbslam
