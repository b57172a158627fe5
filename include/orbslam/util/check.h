// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Stops the program when a condition that only a bug can break is false. Expected failure is a Result or
/// an std::optional, never a check.
#define ORBSLAM_CHECK(condition)                                              \
  do {                                                                        \
    if (!(condition)) ::orbslam::CheckFailed(#condition, __FILE__, __LINE__); \
  } while (false)

namespace orbslam {

[[noreturn]] void CheckFailed(const char* condition, const char* file, int line);

}  // namespace orbslam
