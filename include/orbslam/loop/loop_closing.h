// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "orbslam/loop/loop_detector.h"
#include "orbslam/loop/loop_options.h"
#include "orbslam/map/map.h"
#include "orbslam/pipeline/edit_turn.h"
#include "orbslam/pipeline/messages.h"
#include "orbslam/pipeline/place_index.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/util/stage_timer.h"

namespace orbslam {

/// Recognises places seen before and corrects the map by them. Process is to be called by one thread at a
/// time.
class LoopClosing {
 public:
  /// Whether global bundle adjustment runs in a thread of its own beside all others, or before Process
  /// returns.
  enum class GlobalBundle { kBeside, kInline };

  LoopClosing(const Sensor& sensor, const LoopOptions& options, GlobalBundle global_bundle,
              PlaceIndex* places, EditTurn* turn, Map* map);
  /// Stops and joins a global bundle adjustment that is under way.
  ~LoopClosing();

  void Process(const KeyFrameMapped& message);
  /// Waits for a global bundle adjustment that is under way.
  void Finish();
  /// The same, but gives it up after max_wait.
  void FinishWithin(std::chrono::milliseconds max_wait);

  int num_loops() const { return num_loops_; }
  const StageTimer& timer() const { return timer_; }

 private:
  bool FindAndCloseLoop(KeyFrameId keyframe, const PlaceIndex::Words& words);
  void StartGlobalBundle();

  const Sensor& sensor_;
  const LoopOptions options_;
  const GlobalBundle global_bundle_;
  PlaceIndex* places_;
  EditTurn* turn_;
  Map* map_;
  LoopDetector detector_;
  StageTimer timer_;
  std::atomic<int> num_loops_ = 0;
  KeyFrameId last_loop_;
  std::jthread global_bundle_thread_;
  std::future<void> global_bundle_done_;
};

}  // namespace orbslam
