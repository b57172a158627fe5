// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/map_session.h"

#include "orbslam/loop/loop_corrector.h"

namespace orbslam {
namespace {

constexpr size_t kMaxWaitingKeyFrames = 3;
constexpr size_t kMaxWaitingLoops = 64;
// Frames beside the keyframes in the last adjustment: more where somebody hides part of the room, and points
// are seen for a short time.
constexpr TrajectoryLog::SampleIntervals kSampleInterval{.clear_s = 0.2, .masked_s = 0.1};
constexpr int kMaxSample = 1000;

}  // namespace

MapSession::MapSession(const Sensor& sensor, const Settings& settings, RunMode mode,
                       std::shared_ptr<const Vocabulary> vocabulary, MapData map)
    : sensor_(sensor),
      mode_(mode),
      loop_options_(settings.loops),
      map_(std::move(map)),
      places_(vocabulary ? std::optional<PlaceIndex>(std::in_place, vocabulary) : std::nullopt),
      tracking_(sensor, settings.orb, settings.tracking, settings.keyframes, places_ ? &*places_ : nullptr,
                &map_),
      mapping_(sensor, settings.mapping, &map_),
      trajectory_(settings.motion),
      loop_stage_(
          "loop_closing", kMaxWaitingLoops,
          [this](const KeyFrameMapped& message) { loop_closing_->Process(message); }, mode.OfStages()),
      mapping_stage_(
          "local_mapping", kMaxWaitingKeyFrames,
          [this](const KeyFrameReady& message) { RunMapping(message); }, mode.OfStages()) {
  if (places_) {
    for (const KeyFrame& keyframe : map_.Read()->KeyFrames()) {
      places_->Add(keyframe.id, places_->Transform(*keyframe.features));
    }
  }
  if (places_ && settings.closes_loops) {
    const auto global_bundle =
        mode.is_sequential ? LoopClosing::GlobalBundle::kInline : LoopClosing::GlobalBundle::kBeside;
    loop_closing_.emplace(sensor, settings.loops, global_bundle, &*places_, &turn_, &map_);
  }
  loop_stage_.Start();
  mapping_stage_.Start();
}

FrameReport MapSession::Track(const RgbdImage& image, const MaskOfFrame& mask_of_frame) {
  FrameReport report = tracking_.Process(image, Load(), mask_of_frame);
  trajectory_.Add(image, report);
  for (const PastFrame& frame : report.revised) trajectory_.Revise(frame);
  if (report.new_keyframe) HandOver(*report.new_keyframe);
  return report;
}

/// A recorded sequence can wait, a camera cannot.
MapperLoad MapSession::Load() const {
  if (!mode_.is_live) return {};
  return {.is_idle = mapping_stage_.IsIdle(),
          .accepts_keyframe = mapping_stage_.QueueSize() < kMaxWaitingKeyFrames};
}

void MapSession::HandOver(KeyFrameReady message) {
  if (mode_.is_live) {
    turn_.AskToYield();
  } else {
    mapping_stage_.WaitUntilIdle();
  }
  mapping_stage_.Push(std::move(message));
}

void MapSession::RunMapping(const KeyFrameReady& message) {
  KeyFrameMapped mapped;
  {
    const auto turn = turn_.Take();
    mapped = mapping_.Process(message, mapping_stage_.QueueSize() > 0, turn.ShouldYield());
    has_grown_ = true;
  }
  if (loop_closing_) loop_stage_.Push(mapped);
}

void MapSession::WaitUntilIdle() {
  mapping_stage_.WaitUntilIdle();
  loop_stage_.WaitUntilIdle();
  if (loop_closing_) loop_closing_->Finish();
}

void MapSession::Stop(std::chrono::milliseconds max_wait) {
  mapping_stage_.CloseAndJoin();
  loop_stage_.CloseAndJoin();
  if (loop_closing_) loop_closing_->FinishWithin(max_wait);
  for (PastFrame& frame : tracking_.ReviseRest()) trajectory_.Revise(std::move(frame));
}

void MapSession::AdjustWholeMap(std::stop_token stop) {
  if (!has_grown_) return;
  const auto measure = timer_.Measure("map.final_bundle");
  const auto others = trajectory_.Sample(kSampleInterval, kMaxSample);
  if (!AdjustGlobally(loop_options_, sensor_, others, stop, &turn_, &map_)) return;
  trajectory_.FindPosesAgain(map_, sensor_, stop);
  has_grown_ = false;
}

void MapSession::SetLocalizationMode(bool is_on) {
  WaitUntilIdle();
  tracking_.SetLocalizationMode(is_on);
}

std::optional<Error> MapSession::failure() const {
  if (auto failure = mapping_stage_.failure()) return failure;
  return loop_stage_.failure();
}

std::map<std::string, StageTimer::Statistics> MapSession::Timings() const {
  auto timings = timer_.Summarize();
  timings.merge(tracking_.timer().Summarize());
  timings.merge(mapping_.timer().Summarize());
  if (loop_closing_) timings.merge(loop_closing_->timer().Summarize());
  return timings;
}

}  // namespace orbslam
