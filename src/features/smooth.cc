// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "cpu.h"

namespace orbslam {
namespace {

constexpr int kSize = 7, kRadius = 3;
constexpr double kSigma = 2;
constexpr int kLineFloats = 16;
constexpr int kBlock = 16;  // pixels at a time; the last block of a row overlaps the one before

using Weights = Smoother::Weights;
using RowPointers = std::array<const float*, kSize>;

Weights GaussianWeights() {
  const cv::Mat kernel = cv::getGaussianKernel(kSize, kSigma, CV_32F);
  Weights weights{};
  for (int i = 0; i < kSize; ++i) weights[i] = kernel.at<float>(i);
  return weights;
}

// Index of a row or column beyond the border, mirrored at the last pixel. size > kRadius.
int Mirror(int i, int size) {
  if (i < 0) return -i;
  return i < size ? i : 2 * size - 2 - i;
}

#define ORBSLAM_TARGET_FMA __attribute__((target("avx2,fma")))

// `wide` receives the row in floats, mirrored by kRadius at both ends.
ORBSLAM_TARGET_FMA void Widen(const uint8_t* row, int width, float* wide) {
  for (int block = 0; block < width; block += 8) {
    const int x = std::min(block, width - 8);
    const __m256i values = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + x)));
    _mm256_storeu_ps(wide + kRadius + x, _mm256_cvtepi32_ps(values));
  }
  for (int i = 1; i <= kRadius; ++i) {
    wide[kRadius - i] = row[i];
    wide[kRadius + width - 1 + i] = row[width - 1 - i];
  }
}

// In the order in which OpenCV adds, from left to right.
ORBSLAM_TARGET_FMA void SmoothAlongRow(const float* wide, const Weights& weights, int width, float* out) {
  for (int block = 0; block < width; block += 8) {
    const float* in = wide + std::min(block, width - 8);
    __m256 sum = _mm256_mul_ps(_mm256_set1_ps(weights[0]), _mm256_loadu_ps(in));
    for (int k = 1; k < kSize; ++k) {
      sum = _mm256_fmadd_ps(_mm256_set1_ps(weights[k]), _mm256_loadu_ps(in + k), sum);
    }
    _mm256_storeu_ps(out + (in - wide), sum);
  }
}

// Centre first, then pairs from the inside out.
ORBSLAM_TARGET_FMA inline __m256i SmoothDown8(const RowPointers& rows, const Weights& weights, int x) {
  __m256 sum = _mm256_mul_ps(_mm256_set1_ps(weights[kRadius]), _mm256_loadu_ps(rows[kRadius] + x));
  for (int k = 1; k <= kRadius; ++k) {
    const __m256 pair =
        _mm256_add_ps(_mm256_loadu_ps(rows[kRadius + k] + x), _mm256_loadu_ps(rows[kRadius - k] + x));
    sum = _mm256_fmadd_ps(pair, _mm256_set1_ps(weights[kRadius + k]), sum);
  }
  return _mm256_cvtps_epi32(sum);
}

ORBSLAM_TARGET_FMA void SmoothDown(const RowPointers& rows, const Weights& weights, int width, uint8_t* out) {
  for (int block = 0; block < width; block += kBlock) {
    const int x = std::min(block, width - kBlock);
    // The pack works on halves; the permutation puts the quarters back in order.
    const __m256i words = _mm256_permute4x64_epi64(
        _mm256_packs_epi32(SmoothDown8(rows, weights, x), SmoothDown8(rows, weights, x + 8)), 0xD8);
    const __m128i bytes = _mm_packus_epi16(_mm256_castsi256_si128(words), _mm256_extracti128_si256(words, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + x), bytes);
  }
}

const bool kHasAvx2 = HasAvx2AndFma();

}  // namespace

Smoother::Smoother() : weights_(GaussianWeights()) {}

void Smoother::Smooth(const cv::Mat& image, cv::Mat* out) {
  out->create(image.size(), CV_8UC1);
  if (kHasAvx2 && image.cols >= kBlock && image.rows > kRadius) {
    SmoothBySimd(image, out);
  } else {
    SmoothByOpenCv(image, out);
  }
}

void Smoother::SmoothBySimd(const cv::Mat& image, cv::Mat* out) {
  const int width = image.cols, height = image.rows;
  // The rows in the window, smoothed along, and a wide one; each in cache lines of its own.
  const int stride = (width + 2 * kRadius + kLineFloats - 1) / kLineFloats * kLineFloats;
  buffer_.resize((kSize + 1) * stride + kLineFloats);
  float* begin =
      static_cast<float*>(cv::alignPtr(static_cast<void*>(buffer_.data()), kLineFloats * sizeof(float)));
  float* wide = begin + kSize * stride;
  const auto smoothed_row = [&](int y) { return begin + y % kSize * stride; };
  for (int next = 0; next < height + kRadius; ++next) {
    if (next < height) {
      Widen(image.ptr(next), width, wide);
      SmoothAlongRow(wide, weights_, width, smoothed_row(next));
    }
    const int y = next - kRadius;
    if (y < 0) continue;
    RowPointers rows;
    for (int k = 0; k < kSize; ++k) rows[k] = smoothed_row(Mirror(y + k - kRadius, height));
    SmoothDown(rows, weights_, width, out->ptr(y));
  }
}

void Smoother::SmoothByOpenCv(const cv::Mat& image, cv::Mat* out) {
  cv::copyMakeBorder(image, padded_, kRadius, kRadius, kRadius, kRadius,
                     cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
  const cv::Mat inside = padded_(cv::Rect(kRadius, kRadius, image.cols, image.rows));
  cv::GaussianBlur(inside, *out, cv::Size(kSize, kSize), kSigma, kSigma, cv::BORDER_REFLECT_101);
}

}  // namespace orbslam
