// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_closing.h"

#include "orbslam/loop/loop_corrector.h"
#include "orbslam/loop/loop_verifier.h"

namespace orbslam {

LoopClosing::LoopClosing(const Sensor& sensor, const LoopOptions& options, GlobalBundle global_bundle,
                         PlaceIndex* places, EditTurn* turn, Map* map)
    : sensor_(sensor),
      options_(options),
      global_bundle_(global_bundle),
      places_(places),
      turn_(turn),
      map_(map),
      detector_(options_, *map, *places) {}

LoopClosing::~LoopClosing() {
  global_bundle_thread_.request_stop();
  Finish();
}

void LoopClosing::Process(const KeyFrameMapped& message) {
  const auto measure = timer_.Measure("loop");
  std::shared_ptr<const FrameFeatures> features;
  {
    const auto guard = map_->Read();
    const KeyFrame* keyframe = guard->Find(message.keyframe);
    if (keyframe == nullptr) return;
    features = keyframe->features;
  }
  const auto words = places_->Transform(*features);
  places_->Add(message.keyframe, words);
  const bool is_too_soon =
      last_loop_.IsValid() && message.keyframe.value < last_loop_.value + options_.min_keyframes_between;
  if (!is_too_soon && FindAndCloseLoop(message.keyframe, *words)) {
    last_loop_ = message.keyframe;
    ++num_loops_;
    detector_.Forget();
    StartGlobalBundle();
  }
}

bool LoopClosing::FindAndCloseLoop(KeyFrameId keyframe, const PlaceIndex::Words& words) {
  for (const KeyFrameId candidate : detector_.Detect(keyframe, words)) {
    const auto measure = timer_.Measure("loop.verify");
    const auto loop = VerifyLoop(options_, sensor_, *places_, *map_, keyframe, candidate);
    if (loop && CloseLoop(options_, sensor_, *loop, turn_, map_)) return true;
  }
  return false;
}

void LoopClosing::StartGlobalBundle() {
  global_bundle_thread_.request_stop();  // one under way knows nothing of the new loop
  Finish();
  if (global_bundle_ == GlobalBundle::kInline) {
    AdjustGlobally(options_, sensor_, {}, {}, turn_, map_);
  } else {
    std::promise<void> done;
    global_bundle_done_ = done.get_future();
    global_bundle_thread_ = std::jthread([this, done = std::move(done)](std::stop_token stop) mutable {
      AdjustGlobally(options_, sensor_, {}, stop, turn_, map_);
      done.set_value();
    });
  }
}

void LoopClosing::Finish() {
  if (global_bundle_thread_.joinable()) global_bundle_thread_.join();
}

void LoopClosing::FinishWithin(std::chrono::milliseconds max_wait) {
  if (!global_bundle_thread_.joinable()) return;
  if (global_bundle_done_.wait_for(max_wait) != std::future_status::ready)
    global_bundle_thread_.request_stop();
  Finish();
}

}  // namespace orbslam
