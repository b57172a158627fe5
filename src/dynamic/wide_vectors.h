// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A function that is compiled for processors with AVX2, together with all that it calls and that can be
// inlined. Whoever calls it asks HasWideVectors first.
#if defined(__x86_64__)
#define ORBSLAM_WIDE_VECTORS __attribute__((target("avx2"), flatten))
#else
#define ORBSLAM_WIDE_VECTORS
#endif

namespace orbslam {

inline bool HasWideVectors() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace orbslam
