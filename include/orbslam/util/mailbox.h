// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace orbslam {

/// Holds the newest value only, for a reader that wants no other; T need only be movable.
///
/// Waiting: Put never waits; the Take functions wait for a value. Closing: from Close() on nothing is stored,
/// a value that is inside can still be taken, and every waiter returns. Close() is final, may be called by
/// anyone and repeatedly. Before the mailbox is destroyed its users must have been joined.
template <class T>
class Mailbox {
 public:
  using Deadline = std::chrono::steady_clock::time_point;

  /// Replaces a value that nobody has taken. Stores nothing if closed.
  void Put(T value) {
    std::optional<T> stored(std::move(value));
    // Locked after stored is made, so that the value replaced is destroyed after the lock is released.
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    value_.swap(stored);
    changed_.notify_one();
  }

  /// Never waits. Nothing if empty.
  std::optional<T> TryTake() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

  /// Waits for a value. Nothing if closed and empty.
  std::optional<T> Take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || value_; });
    return std::exchange(value_, std::nullopt);
  }

  /// Waits for a value until the deadline; one that is there already is taken even if that has passed.
  std::optional<T> TakeUntil(Deadline deadline) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, deadline, [this] { return closed_ || value_; });
    return std::exchange(value_, std::nullopt);
  }

  /// Waits until the deadline for a value of which matches(const T&) is true, discarding all others. matches
  /// is called without the lock.
  template <class Predicate>
  std::optional<T> TakeMatching(Predicate matches, Deadline deadline) {
    do {
      std::optional<T> value = TakeUntil(deadline);
      if (!value || matches(std::as_const(*value))) return value;
    } while (std::chrono::steady_clock::now() < deadline);
    return std::nullopt;
  }

  void Close() {
    // The flag changes under the mutex: a waiter that has just seen it unset could otherwise miss the call.
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  bool IsClosed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  std::optional<T> value_;
  bool closed_ = false;
};

}  // namespace orbslam
