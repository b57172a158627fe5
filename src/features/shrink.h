// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace orbslam {

/// Makes an image smaller by bilinear interpolation with 8-bit weights: cv::resize with INTER_LINEAR_EXACT,
/// to the bit, but several times as fast for factors below 2. Remembers the sizes it was last used for.
class Shrinker {
 public:
  /// image and *out: CV_8UC1, not the same memory. *out is allocated as needed; size must not be empty.
  void Shrink(const cv::Mat& image, cv::Size size, cv::Mat* out);

 private:
  // Neighbouring pixels `first` and first + 1, with weights out of 256.
  struct Tap {
    int first = 0;
    int weights[2] = {256, 0};
  };
  // Eight output pixels in two fours: where the eight input words of each start, which of them make pairs
  // (byte numbers), and the pairs' weights.
  struct alignas(32) Octet {
    std::array<int8_t, 32> shuffle{};
    std::array<int16_t, 16> weights{};
    std::array<int, 2> start{};
  };

  static std::vector<Tap> MakeTaps(int in, int out);
  void Plan(cv::Size in, cv::Size out);
  void PlanOctets();
  void MixColumns(uint8_t* out) const;

  cv::Size in_, out_;
  bool fast_ = false;  // no four output pixels span more than eight input pixels; nothing is too narrow
  std::vector<Tap> rows_;
  std::vector<Octet> octets_;
  std::vector<uint16_t> words_;  // a row, interpolated vertically, of 8.8 bits less 0x8000
};

}  // namespace orbslam
