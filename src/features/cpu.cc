// SPDX-License-Identifier: GPL-3.0-or-later
#include "cpu.h"

#include <cstdlib>

namespace orbslam {
namespace {

bool IsAllowed() { return std::getenv("ORBSLAM_PORTABLE_CODE") == nullptr; }

}  // namespace

bool HasAvx2AndFma() {
  return IsAllowed() && __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
}

bool HasPopcnt() { return IsAllowed() && __builtin_cpu_supports("popcnt") != 0; }

}  // namespace orbslam
