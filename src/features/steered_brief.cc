// SPDX-License-Identifier: GPL-3.0-or-later
#include "steered_brief.h"

#include <immintrin.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "brief_pattern.h"
#include "cpu.h"

namespace orbslam {
namespace {

// The pattern by coordinate, so that 8 pairs (one byte of the descriptor) lie side by side.
struct alignas(32) PatternColumns {
  float x1[256]{}, y1[256]{}, x2[256]{}, y2[256]{};

  constexpr PatternColumns() {
    for (int i = 0; i < 256; ++i) {
      x1[i] = kBriefPattern[i][0];
      y1[i] = kBriefPattern[i][1];
      x2[i] = kBriefPattern[i][2];
      y2[i] = kBriefPattern[i][3];
    }
  }
};

constexpr PatternColumns kPattern;

using Bytes = uint8_t[32];

void Describe(const uint8_t* pixel, int step, float cosine, float sine, Bytes& bytes) {
  const auto value = [&](float x, float y) {
    const int u = _mm_cvtss_si32(_mm_set_ss(x * cosine - y * sine));
    const int v = _mm_cvtss_si32(_mm_set_ss(x * sine + y * cosine));
    return pixel[v * step + u];
  };
  for (int byte = 0; byte < 32; ++byte) {
    int bits = 0;
    for (int k = 0; k < 8; ++k) {
      const int i = 8 * byte + k;
      bits |= (value(kPattern.x1[i], kPattern.y1[i]) < value(kPattern.x2[i], kPattern.y2[i])) << k;
    }
    bytes[byte] = static_cast<uint8_t>(bits);
  }
}

struct Rotation {
  __m256 cosine, sine;
  __m256i step;
};

// The pixels' values at 8 rotated points. Each gather reads 4 bytes, of which the first counts.
__attribute__((target("avx2"), always_inline)) inline __m256i Gather(const uint8_t* pixel, const float* x_px,
                                                                     const float* y_px,
                                                                     const Rotation& rotation) {
  const __m256 x = _mm256_load_ps(x_px), y = _mm256_load_ps(y_px);
  const __m256i u =
      _mm256_cvtps_epi32(_mm256_sub_ps(_mm256_mul_ps(x, rotation.cosine), _mm256_mul_ps(y, rotation.sine)));
  const __m256i v =
      _mm256_cvtps_epi32(_mm256_add_ps(_mm256_mul_ps(x, rotation.sine), _mm256_mul_ps(y, rotation.cosine)));
  const __m256i offset = _mm256_add_epi32(_mm256_mullo_epi32(v, rotation.step), u);
  const __m256i values = _mm256_i32gather_epi32(reinterpret_cast<const int*>(pixel), offset, 1);
  return _mm256_and_si256(values, _mm256_set1_epi32(255));
}

__attribute__((target("avx2"))) void DescribeAvx2(const uint8_t* pixel, int step, float cosine, float sine,
                                                  Bytes& bytes) {
  const Rotation rotation{_mm256_set1_ps(cosine), _mm256_set1_ps(sine), _mm256_set1_epi32(step)};
  for (int byte = 0; byte < 32; ++byte) {
    const __m256i first = Gather(pixel, kPattern.x1 + 8 * byte, kPattern.y1 + 8 * byte, rotation);
    const __m256i second = Gather(pixel, kPattern.x2 + 8 * byte, kPattern.y2 + 8 * byte, rotation);
    const __m256 less = _mm256_castsi256_ps(_mm256_cmpgt_epi32(second, first));
    bytes[byte] = static_cast<uint8_t>(_mm256_movemask_ps(less));
  }
}

const bool kHasAvx2 = HasAvx2AndFma();

}  // namespace

Descriptor DescribePixel(const uint8_t* pixel, ptrdiff_t step, float angle_deg) {
  const float angle = angle_deg * static_cast<float>(std::numbers::pi / 180.0);
  // In double, then rounded, as in OpenCV.
  const auto cosine = static_cast<float>(std::cos(static_cast<double>(angle)));
  const auto sine = static_cast<float>(std::sin(static_cast<double>(angle)));
  Bytes bytes;
  (kHasAvx2 ? DescribeAvx2 : Describe)(pixel, static_cast<int>(step), cosine, sine, bytes);
  Descriptor descriptor;
  std::memcpy(descriptor.words.data(), bytes, sizeof(bytes));
  return descriptor;
}

}  // namespace orbslam
