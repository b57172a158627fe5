// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

/// Independent values, uniform in [-amplitude, amplitude].
cv::Mat WhiteNoise(cv::Size size, float amplitude, Rng* rng) {
  cv::Mat noise(size, CV_32FC1);
  const float scale = amplitude / 127.5f;
  uint64_t bits = 0;
  int left = 0;
  for (int y = 0; y < size.height; ++y) {
    auto* row = noise.ptr<float>(y);
    for (int x = 0; x < size.width; ++x, --left, bits >>= 8) {
      if (left == 0) bits = (*rng)(), left = 8;
      row[x] = scale * (static_cast<float>(bits & 255) - 127.5f);
    }
  }
  return noise;
}

}  // namespace

cv::Mat FractalNoise(cv::Size size, int coarsest_texels, double smoothness, Rng* rng) {
  int cell = 1;
  while (2 * cell <= coarsest_texels) cell *= 2;
  const auto cells = [&](int length) { return (length + cell - 1) / cell + 1; };
  double amplitude = 1, variance = 1.0 / 3;
  cv::Mat field = WhiteNoise({cells(size.width), cells(size.height)}, 1, rng), finer;
  while (cell > 1) {
    cell /= 2;
    cv::resize(field, finer, {2 * field.cols, 2 * field.rows}, 0, 0, cv::INTER_LINEAR);
    // The fine grid need not be larger than what is asked for.
    field = finer(cv::Rect(0, 0, std::min(finer.cols, cells(size.width) + 1),
                           std::min(finer.rows, cells(size.height) + 1)))
                .clone();
    amplitude *= 1 - smoothness;
    variance += amplitude * amplitude / 3;
    field += WhiteNoise(field.size(), static_cast<float>(amplitude), rng);
  }
  cv::Mat result = field(cv::Rect({}, size)).clone();
  result *= 1 / std::sqrt(variance);
  return result;
}

}  // namespace orbslam
