// SPDX-License-Identifier: GPL-3.0-or-later
#include "shrink.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "cpu.h"

namespace orbslam {
namespace {

constexpr int kBlock = 16;  // input pixels at a time, vertically
constexpr int kOctet = 8;   // output pixels at a time, horizontally

const bool kHasAvx2 = HasAvx2AndFma();

#define ORBSLAM_TARGET_AVX2 __attribute__((target("avx2")))

ORBSLAM_TARGET_AVX2 inline __m256i LoadWords(const uint8_t* p) {
  return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
}

// Weighted sums of two rows, less 0x8000 so that they are signed words.
ORBSLAM_TARGET_AVX2 void MixRows(const uint8_t* upper, const uint8_t* lower, const int (&weights)[2],
                                 int width, uint16_t* words) {
  const __m256i upper_weight = _mm256_set1_epi16(static_cast<int16_t>(weights[0]));
  const __m256i lower_weight = _mm256_set1_epi16(static_cast<int16_t>(weights[1]));
  const __m256i sign = _mm256_set1_epi16(INT16_MIN);
  for (int block = 0; block < width; block += kBlock) {
    const int x = std::min(block, width - kBlock);
    const __m256i sum = _mm256_add_epi16(_mm256_mullo_epi16(LoadWords(upper + x), upper_weight),
                                         _mm256_mullo_epi16(LoadWords(lower + x), lower_weight));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(words + x), _mm256_xor_si256(sum, sign));
  }
}

}  // namespace

// Pixel centres of both images cover the same range; beyond the outermost centres, the border pixel.
std::vector<Shrinker::Tap> Shrinker::MakeTaps(int in, int out) {
  const double scale = 1.0 / (static_cast<double>(out) / in);
  std::vector<Tap> taps(out);
  for (int i = 0; i < out; ++i) {
    const double position = scale * (i + 0.5) - 0.5;
    const int first = static_cast<int>(std::floor(position));
    const int second_weight = static_cast<int>(std::lrint((position - first) * 256));
    if (first < 0) continue;
    const bool last = first >= in - 1;
    taps[i] = last ? Tap{in - 1, {256, 0}} : Tap{first, {256 - second_weight, second_weight}};
  }
  return taps;
}

void Shrinker::Plan(cv::Size in, cv::Size out) {
  in_ = in;
  out_ = out;
  rows_ = MakeTaps(in.height, out.height);
  words_.assign(in.width + kBlock, 0);
  octets_.clear();
  fast_ = kHasAvx2 && in.width >= kBlock && out.width >= kOctet;
  if (fast_) PlanOctets();
}

void Shrinker::PlanOctets() {
  const std::vector<Tap> columns = MakeTaps(in_.width, out_.width);
  for (int block = 0; block < out_.width; block += kOctet) {
    const Tap* taps = columns.data() + std::min(block, out_.width - kOctet);
    Octet octet{.start = {taps[0].first, taps[kOctet / 2].first}};
    for (int i = 0; i < kOctet; ++i) {
      const int first = taps[i].first - octet.start[i / (kOctet / 2)];
      fast_ = fast_ && first < 7;
      for (int byte = 0; byte < 4; ++byte)
        octet.shuffle[4 * i + byte] = static_cast<int8_t>(2 * first + byte);
      for (int k = 0; k < 2; ++k) octet.weights[2 * i + k] = static_cast<int16_t>(taps[i].weights[k]);
    }
    octets_.push_back(octet);
  }
}

void Shrinker::Shrink(const cv::Mat& image, cv::Size size, cv::Mat* out) {
  if (image.size() != in_ || size != out_) Plan(image.size(), size);
  out->create(size, CV_8UC1);
  if (!fast_) {
    cv::resize(image, *out, size, 0, 0, cv::INTER_LINEAR_EXACT);
    return;
  }
  for (int y = 0; y < size.height; ++y) {
    const Tap& tap = rows_[y];
    const uint8_t* lower = image.ptr(std::min(tap.first + 1, image.rows - 1));
    MixRows(image.ptr(tap.first), lower, tap.weights, image.cols, words_.data());
    MixColumns(out->ptr(y));
  }
}

ORBSLAM_TARGET_AVX2 void Shrinker::MixColumns(uint8_t* out) const {
  // Gives back the 0x8000 that MixRows took, times 256, the sum of the weights; and rounds.
  const __m256i offset = _mm256_set1_epi32((0x8000 << 8) + 0x8000);
  int block = 0;
  for (const Octet& octet : octets_) {
    const __m256i words =
        _mm256_loadu2_m128i(reinterpret_cast<const __m128i*>(words_.data() + octet.start[1]),
                            reinterpret_cast<const __m128i*>(words_.data() + octet.start[0]));
    const auto shuffle = reinterpret_cast<const __m256i*>(octet.shuffle.data());
    const auto weights = reinterpret_cast<const __m256i*>(octet.weights.data());
    const __m256i pairs = _mm256_shuffle_epi8(words, _mm256_load_si256(shuffle));
    const __m256i sums = _mm256_add_epi32(_mm256_madd_epi16(pairs, _mm256_load_si256(weights)), offset);
    const __m256i values = _mm256_srli_epi32(sums, 16);
    const __m128i packed =
        _mm_packus_epi32(_mm256_castsi256_si128(values), _mm256_extracti128_si256(values, 1));
    const int x = std::min(block, out_.width - kOctet);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(out + x), _mm_packus_epi16(packed, packed));
    block += kOctet;
  }
}

}  // namespace orbslam
