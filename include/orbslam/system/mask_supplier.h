// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "orbslam/dynamic/dynamic_detector.h"
#include "orbslam/pipeline/messages.h"
#include "orbslam/system/run_mode.h"
#include "orbslam/system/settings.h"
#include "orbslam/util/mailbox.h"
#include "orbslam/util/stage.h"
#include "orbslam/util/stage_timer.h"

namespace orbslam {

/// A mask of the user's own for a frame, say of a segmentation network: CV_8UC1 of the image's size, non-zero
/// on what may move; empty: none. It is used widened by Settings::user_mask_margin_px. Called from the thread
/// that calls System::TrackRgbd.
using UserMask = std::function<cv::Mat(const RgbdImage&)>;

/// Where masks come from: the DynamicDetector, on a thread of its own beside Tracking, the user, or both
/// united.
class MaskSupplier {
 public:
  /// Neither detector nor user_mask: there are no masks, and nothing is spent on them.
  MaskSupplier(const Settings& settings, bool use_detector, RunMode mode, UserMask user_mask);
  ~MaskSupplier();

  bool HasSource() const { return detector_ || user_mask_; }

  /// The frame is here: the detector begins. A live detector that is still busy with earlier frames skips
  /// this one.
  void Begin(std::shared_ptr<const RgbdImage> image);

  /// The mask of the frame begun last. Recorded sequences wait for it; live ones for most of a frame's time,
  /// and then take the last mask there is, warped to now; see WarpMask.
  DynamicMask Take(const Rigid3d& now_from_last);

  /// Finishes and joins the detector's thread.
  void Stop();
  /// What the detector died of, if it did: from then on there are no masks of its.
  std::optional<Error> failure() const { return stage_.failure(); }
  /// "detect" and "detect_cpu". To be called after Stop.
  std::map<std::string, StageTimer::Statistics> Timings() const { return timer_.Summarize(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Job {
    std::shared_ptr<const RgbdImage> image;
    Clock::time_point begun;
  };
  struct Masked {
    std::shared_ptr<const RgbdImage> image;
    DynamicMask mask;
  };

  void Detect(const Job& job);
  DynamicMask TakeDetected(const Rigid3d& now_from_last);
  DynamicMask WarpLast(const Rigid3d& now_from_last) const;

  const PinholeCamera camera_;
  const RunMode mode_;
  const double patience_s_;  // of a live Take, from Begin
  const UserMask user_mask_;
  const int user_mask_margin_px_;
  std::optional<DynamicDetector> detector_;
  StageTimer timer_;
  Job now_;
  Masked last_;  // the newest mask that was taken
  Mailbox<Masked> mailbox_;
  Stage<Job> stage_;  // last: joined before what it works on goes away
};

}  // namespace orbslam
