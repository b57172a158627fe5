// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace orbslam {

/// Four 8-bit channels in one word, blue lowest, blended two channels at a time in the 16-bit lanes of a
/// word. weight_b in [0, 256].
inline uint32_t BlendBgra(uint32_t a, uint32_t b, uint32_t weight_b) {
  constexpr uint32_t kLanes = 0x00FF00FF, kHalf = 0x00800080;
  const uint32_t weight_a = 256 - weight_b;
  const uint32_t even = ((a & kLanes) * weight_a + (b & kLanes) * weight_b + kHalf) >> 8 & kLanes;
  const uint32_t odd = ((a >> 8 & kLanes) * weight_a + (b >> 8 & kLanes) * weight_b + kHalf) & ~kLanes;
  return even | odd;
}

/// An immutable picture with its mip pyramid (Williams, SIGGRAPH 1983).
class Texture {
 public:
  static constexpr int kNumLevels = 5;
  static constexpr int kSideMultiple = 1 << (kNumLevels - 1);  // so that every level halves exactly

  /// image: CV_8UC4, both sides positive multiples of kSideMultiple, at least twice that.
  explicit Texture(const cv::Mat& image);

  int width() const { return levels_[0].cols; }
  int height() const { return levels_[0].rows; }

  /// Bilinear lookup at (u, v) in [0, 1]^2 (clamped), BGRA packed as in BlendBgra.
  uint32_t Sample(float u, float v, int level) const {
    const cv::Mat& image = levels_[level];
    const uint32_t x = FixedPoint(u, image.cols), y = FixedPoint(v, image.rows);
    const uint32_t* top = image.ptr<uint32_t>(static_cast<int>(y >> 8)) + (x >> 8);
    const uint32_t* bottom = top + image.cols;
    return BlendBgra(BlendBgra(top[0], top[1], x & 255), BlendBgra(bottom[0], bottom[1], x & 255), y & 255);
  }

 private:
  // Texel coordinate of a fraction of the side, 8 fractional bits, so that a right-hand neighbour exists.
  static uint32_t FixedPoint(float fraction, int side) {
    const float texel = fraction * static_cast<float>(side) - 0.5f;
    return static_cast<uint32_t>(
        std::clamp(texel * 256.0f, 0.0f, static_cast<float>(side - 1) * 256.0f - 1.0f));
  }

  std::array<cv::Mat, kNumLevels> levels_;  // continuous
};

}  // namespace orbslam
