// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pthread.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "orbslam/util/bounded_queue.h"
#include "orbslam/util/check.h"
#include "orbslam/util/resource_usage.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// Where a stage's messages are handled: on its own thread, or on that of whoever pushes, before Push
/// returns.
enum class StageMode { kThreaded, kInline };

/// The thread shell round a synchronous handler: a queue, and a thread that handles its messages one by one
/// in the order of their coming.
///
/// Waiting: Push waits while the queue is full, WaitUntilIdle until all that was pushed is handled; before
/// Start() that may be for ever. Closing: CloseAndJoin() accepts no more, handles what is queued and joins.
/// A handler that throws closes its stage: what is still queued is dropped, so nobody waits for it, and
/// failure() tells. A handler must not join or wait for its own stage. Inline, Push must come from one
/// thread.
template <class Message>
class Stage {
 public:
  using Handler = std::function<void(Message)>;
  using Mode = StageMode;

  /// Starts nothing. The first 15 characters of name become the thread's; capacity is the queue's, > 0.
  Stage(std::string name, size_t capacity, Handler handler, Mode mode = Mode::kThreaded)
      : name_(std::move(name)), handler_(std::move(handler)), mode_(mode), queue_(capacity) {}
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage() { CloseAndJoin(); }

  /// Launches the thread, once; nothing to do if inline, started or closed already.
  void Start() {
    const std::lock_guard lock(thread_mutex_);
    if (mode_ == Mode::kInline || thread_.joinable() || queue_.IsClosed()) return;
    thread_ = std::jthread([this] { Run(); });
  }

  /// False if closed: the message is lost. True: it will be handled, unless one before it fails.
  bool Push(Message message) {
    if (mode_ == Mode::kInline) return PushInline(message);
    AddPending();
    const bool pushed = queue_.Push(std::move(message));
    if (!pushed) RemovePending();
    return pushed;
  }

  /// Never waits for room. False if full or closed: the message stays with the caller, unchanged.
  bool TryPush(Message& message) {
    if (mode_ == Mode::kInline) return PushInline(message);
    AddPending();
    const bool pushed = queue_.TryPush(message);
    if (!pushed) RemovePending();
    return pushed;
  }

  /// Nothing queued and nothing being handled.
  bool IsIdle() const {
    const std::lock_guard lock(state_mutex_);
    return pending_ == 0;
  }
  void WaitUntilIdle() const {
    std::unique_lock lock(state_mutex_);
    idle_.wait(lock, [this] { return pending_ == 0; });
  }
  size_t QueueSize() const { return queue_.size(); }

  /// Returns when all messages are handled and the thread has ended; may be repeated. The messages of a stage
  /// that was never started are dropped.
  void CloseAndJoin() {
    queue_.Close();
    const std::lock_guard lock(thread_mutex_);
    ORBSLAM_CHECK(thread_.get_id() != std::this_thread::get_id());
    if (thread_.joinable()) thread_.join();
    while (queue_.Pop()) RemovePending();
  }

  /// What the handler threw, if it did.
  std::optional<Error> failure() const {
    const std::lock_guard lock(state_mutex_);
    return failure_;
  }

  /// CPU time up to the last message handled: of the thread or, if inline, of the handler (which includes
  /// inline stages that it pushes to).
  double CpuSeconds() const { return cpu_s_; }

 private:
  void Run() {
    pthread_setname_np(pthread_self(), name_.substr(0, 15).c_str());
    while (std::optional<Message> message = queue_.Pop()) {
      if (!failed_) Handle(std::move(*message));
      message.reset();  // frees what it holds before anyone is told that it is done
      cpu_s_ = ThreadCpuSeconds();
      RemovePending();
    }
  }

  bool PushInline(Message& message) {
    if (queue_.IsClosed()) return false;
    const CpuStopwatch stopwatch;
    Handle(std::move(message));
    cpu_s_ = cpu_s_ + stopwatch.CpuSeconds();
    return true;
  }

  void Handle(Message&& message) {
    try {
      handler_(std::move(message));
    } catch (const std::exception& exception) {
      Fail(exception.what());
    } catch (...) {
      Fail("unknown exception");
    }
  }

  void Fail(const std::string& what) {
    {
      const std::lock_guard lock(state_mutex_);
      failure_ = Error{name_ + ": " + what};
    }
    failed_ = true;
    queue_.Close();
  }

  // A message is counted from before it is queued until after it is handled, so that it is in view all along.
  void AddPending() {
    const std::lock_guard lock(state_mutex_);
    ++pending_;
  }
  void RemovePending() {
    const std::lock_guard lock(state_mutex_);
    if (--pending_ == 0) idle_.notify_all();
  }

  const std::string name_;
  const Handler handler_;
  const Mode mode_;
  BoundedQueue<Message> queue_;
  bool failed_ = false;  // used by the handling thread only
  std::atomic<double> cpu_s_ = 0.0;

  mutable std::mutex state_mutex_;  // guards the next three
  mutable std::condition_variable idle_;
  size_t pending_ = 0;
  std::optional<Error> failure_;

  std::mutex thread_mutex_;  // guards the thread object; held while joining
  std::jthread thread_;
};

}  // namespace orbslam
