// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace orbslam {

/// Seconds since this process was started (exec), to 10 ms.
double SecondsSinceProcessStart();
/// CPU time of the process, user and system, seconds.
double ProcessCpuSeconds();
/// CPU time of the calling thread, seconds.
double ThreadCpuSeconds();
/// Largest resident size so far, megabytes (10^6 bytes).
double PeakMemoryMb();

/// Wall and CPU time of the calling thread since it was made.
class CpuStopwatch {
 public:
  CpuStopwatch() : wall_start_(std::chrono::steady_clock::now()), cpu_start_s_(ThreadCpuSeconds()) {}
  double WallSeconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start_).count();
  }
  double CpuSeconds() const { return ThreadCpuSeconds() - cpu_start_s_; }

 private:
  std::chrono::steady_clock::time_point wall_start_;
  double cpu_start_s_;
};

}  // namespace orbslam
