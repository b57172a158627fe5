// SPDX-License-Identifier: GPL-3.0-or-later
#include <emmintrin.h>

#include <cstdint>

namespace orbslam {
namespace {

struct Simd {
  using Reg = __m128i;
  static constexpr int kBytes = 16;
  static Reg Load(const uint8_t* p) { return _mm_loadu_si128(reinterpret_cast<const Reg*>(p)); }
  static void Store(uint8_t* p, Reg a) { _mm_storeu_si128(reinterpret_cast<Reg*>(p), a); }
  static Reg Fill(uint8_t value) { return _mm_set1_epi8(static_cast<char>(value)); }
  static Reg Min(Reg a, Reg b) { return _mm_min_epu8(a, b); }
  static Reg Max(Reg a, Reg b) { return _mm_max_epu8(a, b); }
  static Reg Subtract(Reg a, Reg b) { return _mm_subs_epu8(a, b); }
  static uint32_t NonZero(Reg a) {
    return ~static_cast<uint32_t>(_mm_movemask_epi8(_mm_cmpeq_epi8(a, _mm_setzero_si128()))) & 0xFFFFu;
  }
  static bool Any(Reg a) { return NonZero(a) != 0; }
};

}  // namespace
}  // namespace orbslam

#include "fast_kernel.inc"

namespace orbslam {

const FastKernel kFastSse2 = {ScoreRow, FindPeaks};

}  // namespace orbslam
