// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "orbslam/io/tum_sequence.h"
#include "orbslam/system/progress.h"
#include "orbslam/system/system.h"

namespace orbslam {

struct RunOptions {
  bool realtime = false;  // pace by time stamps; else as fast as possible
  int max_frames = 0;     // 0: all
  Progress::Mode progress = Progress::Mode::kAutomatic;
};

struct RunSummary {
  int frames_listed = 0;     // in the sequence, or max_frames
  int frames_skipped = 0;    // unreadable or of the wrong kind
  int frames_processed = 0;  // given to the system
  int frames_lost = 0;       // processed, without a pose
  bool was_interrupted = false;
  double startup_s = 0;  // from exec to the first frame's being handed over
  double wall_s = 0;
  std::vector<FrameReport> frames;  // one a processed frame, without its mask
};

/// Called for each processed frame; may be empty.
using FrameObserver = std::function<void(const RgbdEntry&, const FrameReport&)>;

/// Runs a sequence through the system. Frames that cannot be read are skipped, counted and warned of. Ends
/// early, with everything so far in place, when is_interrupted becomes true.
RunSummary RunSequence(const TumSequence& sequence, const Settings& settings, const RunOptions& options,
                       const std::atomic<bool>& is_interrupted, const FrameObserver& on_frame,
                       System* system);

}  // namespace orbslam
