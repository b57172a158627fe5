// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <mutex>
#include <stop_token>

#include "orbslam/map/map.h"
#include "orbslam/mapping/culling.h"
#include "orbslam/mapping/mapping_options.h"
#include "orbslam/pipeline/messages.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/util/stage_timer.h"

namespace orbslam {

/// Refines the map round every new keyframe. Process is to be called by one thread at a time.
/// (ORB-SLAM, Mur-Artal et al. 2015, section VI.)
class LocalMapping {
 public:
  LocalMapping(const Sensor& sensor, const MappingOptions& options, Map* map);

  /// more_waiting: further keyframes are queued, so that only what cannot wait is done.
  KeyFrameMapped Process(const KeyFrameReady& message, bool more_waiting, std::stop_token stop = {});

  /// Any thread may ask: Process is at what its stop token cuts short without harm, so that a further
  /// keyframe need not wait. (ORB-SLAM2 interrupts its local bundle adjustment likewise.)
  bool IsRefining() const { return is_refining_; }

  const StageTimer& timer() const { return timer_; }

 private:
  void AcceptKeyFrame(const KeyFrameReady& message);
  void FuseWithNeighbors(KeyFrameId keyframe);
  void AdjustBundle(KeyFrameId keyframe, std::stop_token stop);

  const Sensor& sensor_;
  const MappingOptions options_;
  Map* map_;
  PointCuller point_culler_;
  std::atomic<bool> is_refining_ = false;
  StageTimer timer_;
};

}  // namespace orbslam
