// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/sequence_runner.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "orbslam/io/rgbd_images.h"
#include "orbslam/util/resource_usage.h"

namespace orbslam {
namespace {

using Clock = std::chrono::steady_clock;

/// Holds frames back until their time has come, measured from the first one.
class Pacer {
 public:
  /// Waits in short steps, so that an interruption is heeded.
  void WaitFor(double timestamp_s, const std::atomic<bool>& is_interrupted) {
    if (!first_timestamp_s_) {
      first_timestamp_s_ = timestamp_s;
      start_ = Clock::now();
    }
    const auto due = start_ + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(timestamp_s - *first_timestamp_s_));
    std::unique_lock lock(mutex_);
    while (!is_interrupted && Clock::now() < due) {
      never_.wait_until(lock, std::min(due, Clock::now() + std::chrono::milliseconds(50)));
    }
  }

 private:
  std::optional<double> first_timestamp_s_;
  Clock::time_point start_;
  std::mutex mutex_;
  std::condition_variable never_;
};

/// Warns of the first few, then keeps quiet: a run over a broken disk must not drown its own output.
void WarnOfSkippedFrame(const Error& error, int num_skipped) {
  constexpr int kMaxWarnings = 5;
  if (num_skipped <= kMaxWarnings) spdlog::warn("skipping a frame: {}", error.message);
  if (num_skipped == kMaxWarnings) spdlog::warn("further skipped frames are only counted");
}

std::string Detail(const FrameReport& report, const System& system) {
  return fmt::format("{}  {} matches  {} keyframes", Name(report.state), report.num_matches,
                     system.counts().keyframes);
}

}  // namespace

RunSummary RunSequence(const TumSequence& sequence, const Settings& settings, const RunOptions& options,
                       const std::atomic<bool>& is_interrupted, const FrameObserver& on_frame,
                       System* system) {
  RunSummary summary;
  const int num_entries = static_cast<int>(sequence.entries.size());
  summary.frames_listed = options.max_frames > 0 ? std::min(options.max_frames, num_entries) : num_entries;
  Progress progress(stderr, summary.frames_listed, options.progress);
  const auto start = Clock::now();
  Pacer pacer;
  for (int i = 0; i < summary.frames_listed && !is_interrupted; ++i) {
    const RgbdEntry& entry = sequence.entries[i];
    Result<RgbdImages> images = LoadRgbd(entry, settings.camera, settings.depth);
    if (!images) {
      progress.Finish();
      WarnOfSkippedFrame(images.error(), ++summary.frames_skipped);
      continue;
    }
    if (options.realtime) pacer.WaitFor(entry.timestamp_s, is_interrupted);
    if (summary.frames_processed == 0) summary.startup_s = SecondsSinceProcessStart();
    FrameReport report = system->TrackRgbd({.id = {},
                                            .timestamp_s = entry.timestamp_s,
                                            .timestamp_text = entry.timestamp_text,
                                            .gray = images->gray,
                                            .depth_m = images->depth_m,
                                            .depth_delay_s = entry.depth_delay_s});
    ++summary.frames_processed;
    summary.frames_lost += !report.world_from_camera.has_value();
    if (progress.IsDue(i + 1)) progress.Update(i + 1, Detail(report, *system));
    if (on_frame) on_frame(entry, report);
    report.moving.mask.release();
    summary.frames.push_back(std::move(report));
  }
  summary.was_interrupted = is_interrupted;
  summary.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  return summary;
}

}  // namespace orbslam
