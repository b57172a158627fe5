// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "orbslam/features/orb_extractor.h"
#include "orbslam/map/map.h"
#include "orbslam/pipeline/messages.h"
#include "orbslam/tracking/frame_tracker.h"
#include "orbslam/tracking/local_map_tracker.h"
#include "orbslam/tracking/motion_model.h"
#include "orbslam/tracking/point_counter.h"
#include "orbslam/tracking/tracking_options.h"
#include "orbslam/util/stage_timer.h"

namespace orbslam {

/// Where is the camera? One frame in, one pose out; makes keyframes. Knows nothing of threads: whoever calls Process
/// does so from one thread at a time. (ORB-SLAM2, Mur-Artal and Tardos, T-RO 2017, section III.)
class Tracking {
 public:
  Tracking(const Sensor& sensor, const OrbExtractorOptions& orb, const TrackingOptions& options,
           const KeyFramePolicyOptions& policy, Map* map);

  FrameReport Process(const RgbdImage& image, const MapperLoad& mapper = {});

  /// Time spent in each step, seconds.
  const StageTimer& timer() const { return timer_; }

 private:
  Frame MakeFrame(const RgbdImage& image);
  void Initialize(Frame* frame, FrameReport* report);
  void Track(const MapperLoad& mapper, Frame* frame, FrameReport* report);
  bool FindFirstPose(Frame* frame);
  bool RefineOnLocalMap(Frame* frame, FrameReport* report);
  void FollowMapCorrections();
  bool WantsKeyFrame(const Frame& frame, int num_inliers, const MapperLoad& mapper) const;
  void InsertKeyFrame(Frame* frame, FrameReport* report);
  void Remember(Frame frame, FrameReport* report);

  const Sensor& sensor_;
  const TrackingOptions options_;
  const KeyFramePolicyOptions policy_;
  Map* map_;
  OrbExtractor extractor_;
  FrameTracker frame_tracker_;
  LocalMapTracker local_map_tracker_;
  MotionModel motion_;
  PointCounter counter_;
  StageTimer timer_;

  TrackingState state_ = TrackingState::kNotInitialized;
  std::optional<Frame> last_;      // the last frame that was tracked
  KeyFrameId reference_;           // the keyframe that shares most points with it
  Rigid3d last_from_reference_;
  double last_keyframe_s_ = 0;
  KeyFrameId last_keyframe_;
};

}  // namespace orbslam
