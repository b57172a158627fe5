// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orbslam {

/// Durations of named steps, and their percentiles. Wall time, seconds. Not thread-safe: one a stage.
class StageTimer {
 public:
  /// Measures from its making to its end.
  class Scope {
   public:
    Scope(StageTimer* timer, std::string_view name)
        : timer_(timer), name_(name), start_(std::chrono::steady_clock::now()) {}
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() {
      timer_->Add(name_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
    }

   private:
    StageTimer* timer_;
    std::string_view name_;
    std::chrono::steady_clock::time_point start_;
  };

  /// name must outlive the scope.
  [[nodiscard]] Scope Measure(std::string_view name) { return {this, name}; }
  void Add(std::string_view name, double seconds);

  struct Statistics {
    int count = 0;
    double mean_s = 0, median_s = 0, p90_s = 0, p99_s = 0, max_s = 0;
  };
  std::map<std::string, Statistics> Summarize() const;

 private:
  std::map<std::string, std::vector<double>, std::less<>> seconds_;
};

}  // namespace orbslam
