// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

  const StageTimer& timer() const { return timer_; }

 private:
  void AcceptKeyFrame(const KeyFrameReady& message);
  void FuseWithNeighbors(KeyFrameId keyframe);
  void AdjustBundle(KeyFrameId keyframe, std::stop_token stop);

  const Sensor& sensor_;
  const MappingOptions options_;
  Map* map_;
  PointCuller point_culler_;
  StageTimer timer_;
};

}  // namespace orbslam
