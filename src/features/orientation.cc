// SPDX-License-Identifier: GPL-3.0-or-later
#include "orientation.h"

#include <immintrin.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "cpu.h"

namespace orbslam {
namespace {

struct Moments {
  int x = 0, y = 0;
};

// Half the width of the patch's row at height v: a circle, made symmetric under exchange of u and v.
std::array<int, kPatchRadius + 1> HalfWidths() {
  std::array<int, kPatchRadius + 1> half_width{};
  const double diagonal = kPatchRadius * std::sqrt(0.5);
  const int last = static_cast<int>(std::floor(diagonal + 1));
  for (int v = 0; v <= last; ++v) half_width[v] = static_cast<int>(std::lrint(std::sqrt(225.0 - v * v)));
  int u = 0;
  for (int v = kPatchRadius; v >= static_cast<int>(std::ceil(diagonal)); --v) {
    while (half_width[u] == half_width[u + 1]) ++u;
    half_width[v] = u++;
  }
  return half_width;
}

const std::array<int, kPatchRadius + 1> kHalfWidths = HalfWidths();

Moments PatchMoments(const uint8_t* pixel, ptrdiff_t step) {
  Moments moments;
  for (int v = -kPatchRadius; v <= kPatchRadius; ++v) {
    const uint8_t* row = pixel + v * step;
    const int half_width = kHalfWidths[std::abs(v)];
    int sum = 0;
    for (int u = -half_width; u <= half_width; ++u) {
      moments.x += u * row[u];
      sum += row[u];
    }
    moments.y += v * sum;
  }
  return moments;
}

// For each |v|, 32 weights for the pixels u = -15 ... 16 of a row: u, and 1, inside the patch; 0 outside.
struct alignas(32) RowWeights {
  std::array<std::array<int8_t, 32>, kPatchRadius + 1> u{}, one{};

  RowWeights() {
    for (int v = 0; v <= kPatchRadius; ++v) {
      for (int x = -kHalfWidths[v]; x <= kHalfWidths[v]; ++x) {
        u[v][x + kPatchRadius] = static_cast<int8_t>(x);
        one[v][x + kPatchRadius] = 1;
      }
    }
  }
};

const RowWeights kRowWeights;

__attribute__((target("avx2"))) inline int Sum(__m256i a) {
  __m128i sum = _mm_add_epi32(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
  sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0x4E));
  return _mm_cvtsi128_si32(_mm_add_epi32(sum, _mm_shuffle_epi32(sum, 0xB1)));
}

__attribute__((target("avx2"))) inline __m256i Load(const void* p) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}

__attribute__((target("avx2"))) Moments PatchMomentsAvx2(const uint8_t* pixel, ptrdiff_t step) {
  __m256i moment_x = _mm256_setzero_si256(), moment_y = _mm256_setzero_si256();
  const __m256i ones = _mm256_set1_epi16(1);
  for (int v = -kPatchRadius; v <= kPatchRadius; ++v) {
    const __m256i row = Load(pixel + v * step - kPatchRadius);
    const __m256i by_u = _mm256_maddubs_epi16(row, Load(kRowWeights.u[std::abs(v)].data()));
    const __m256i by_one = _mm256_maddubs_epi16(row, Load(kRowWeights.one[std::abs(v)].data()));
    moment_x = _mm256_add_epi32(moment_x, _mm256_madd_epi16(by_u, ones));
    moment_y =
        _mm256_add_epi32(moment_y, _mm256_madd_epi16(by_one, _mm256_set1_epi16(static_cast<int16_t>(v))));
  }
  return {Sum(moment_x), Sum(moment_y)};
}

const bool kHasAvx2 = HasAvx2AndFma();

}  // namespace

float CentroidAngleDeg(const uint8_t* pixel, ptrdiff_t step) {
  const Moments moments = kHasAvx2 ? PatchMomentsAvx2(pixel, step) : PatchMoments(pixel, step);
  return cv::fastAtan2(static_cast<float>(moments.y), static_cast<float>(moments.x));
}

}  // namespace orbslam
