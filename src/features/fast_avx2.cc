// SPDX-License-Identifier: GPL-3.0-or-later
#include <immintrin.h>

#include <cstdint>

namespace orbslam {
namespace {

struct Simd {
  using Reg = __m256i;
  static constexpr int kBytes = 32;
  static Reg Load(const uint8_t* p) { return _mm256_loadu_si256(reinterpret_cast<const Reg*>(p)); }
  static void Store(uint8_t* p, Reg a) { _mm256_storeu_si256(reinterpret_cast<Reg*>(p), a); }
  static Reg Fill(uint8_t value) { return _mm256_set1_epi8(static_cast<char>(value)); }
  static Reg Min(Reg a, Reg b) { return _mm256_min_epu8(a, b); }
  static Reg Max(Reg a, Reg b) { return _mm256_max_epu8(a, b); }
  static Reg Subtract(Reg a, Reg b) { return _mm256_subs_epu8(a, b); }
  static uint32_t NonZero(Reg a) {
    return ~static_cast<uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(a, _mm256_setzero_si256())));
  }
  static bool Any(Reg a) { return _mm256_testz_si256(a, a) == 0; }
};

}  // namespace
}  // namespace orbslam

#include "fast_kernel.inc"

namespace orbslam {

const FastKernel kFastAvx2 = {ScoreRow, FindPeaks};

}  // namespace orbslam
