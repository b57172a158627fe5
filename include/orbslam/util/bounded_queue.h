// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "orbslam/util/check.h"

namespace orbslam {

/// First in, first out, between any number of threads; T need only be movable.
///
/// Waiting: Push waits for room, Pop for an item; nothing else waits. Closing: from Close() on nothing is
/// accepted, what is inside can still be popped, and every waiter returns. Close() is final, may be called by
/// anyone and repeatedly. Before the queue is destroyed its users must have been joined.
template <class T>
class BoundedQueue {
 public:
  /// capacity > 0: the most items that are ever inside.
  explicit BoundedQueue(size_t capacity) : capacity_(capacity) { ORBSLAM_CHECK(capacity > 0); }

  /// Waits while full. False if closed, also while waiting: the item is lost.
  bool Push(T item) {
    std::unique_lock lock(mutex_);
    not_full_.wait(lock, [this] { return closed_ || items_.size() < capacity_; });
    if (closed_) return false;
    Append(std::move(item));
    return true;
  }

  /// Never waits. False if full or closed: the item stays with the caller, unchanged.
  bool TryPush(T& item) {
    const std::lock_guard lock(mutex_);
    if (closed_ || items_.size() == capacity_) return false;
    Append(std::move(item));
    return true;
  }

  /// Never waits: the oldest item makes room. Returns how many items were lost, 0 or 1: the oldest if the
  /// queue was full, the new one if it was closed.
  size_t PushDropOldest(T item) {
    std::optional<T> dropped;  // destroyed after the lock is released: that may take long
    const std::lock_guard lock(mutex_);
    if (closed_) return 1;
    if (items_.size() == capacity_) dropped = TakeFront();
    Append(std::move(item));
    return dropped ? 1 : 0;
  }

  /// Waits while empty. Nothing if closed and drained.
  std::optional<T> Pop() {
    std::unique_lock lock(mutex_);
    not_empty_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    std::optional<T> item = TakeFront();
    not_full_.notify_one();
    return item;
  }

  void Close() {
    // The flag changes under the mutex: a waiter that has just seen it unset could otherwise miss the call.
    const std::lock_guard lock(mutex_);
    closed_ = true;
    not_empty_.notify_all();
    not_full_.notify_all();
  }

  bool IsClosed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }
  size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }
  size_t capacity() const { return capacity_; }

 private:
  void Append(T&& item) {
    items_.push_back(std::move(item));
    not_empty_.notify_one();
  }

  std::optional<T> TakeFront() {
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    return item;
  }

  const size_t capacity_;
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable not_empty_, not_full_;
  std::deque<T> items_;
  bool closed_ = false;
};

}  // namespace orbslam
