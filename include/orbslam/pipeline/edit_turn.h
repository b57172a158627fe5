// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <utility>

namespace orbslam {

/// Those who edit the map in several steps (local mapper, loop corrector, global bundle adjustment while it
/// is applied) take turns. Whoever wants the turn asks its holder to yield; the holder sees that through its
/// stop token and finishes early.
class EditTurn {
 public:
  /// Holds the turn until it goes out of scope.
  class Holder {
   public:
    Holder(const Holder&) = delete;
    Holder& operator=(const Holder&) = delete;
    ~Holder() { turn_->GiveBack(); }
    std::stop_token ShouldYield() const { return stop_; }

   private:
    friend class EditTurn;
    Holder(EditTurn* turn, std::stop_token stop) : turn_(turn), stop_(std::move(stop)) {}
    EditTurn* turn_;
    std::stop_token stop_;
  };

  /// Waits for the turn, asking its holder to yield.
  [[nodiscard]] Holder Take() {
    std::unique_lock lock(mutex_);
    while (is_held_) {
      stop_.request_stop();
      free_.wait(lock);
    }
    is_held_ = true;
    stop_ = std::stop_source();
    return {this, stop_.get_token()};
  }

  /// Asks the holder, if there is one, to finish early.
  void AskToYield() {
    const std::lock_guard lock(mutex_);
    stop_.request_stop();
  }

 private:
  void GiveBack() {
    const std::lock_guard lock(mutex_);
    is_held_ = false;
    free_.notify_all();  // those who do not get it ask the next holder
  }

  std::mutex mutex_;
  std::condition_variable free_;
  bool is_held_ = false;
  std::stop_source stop_;
};

}  // namespace orbslam
