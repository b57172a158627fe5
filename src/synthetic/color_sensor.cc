// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "normal_table.h"
#include "orbslam/synthetic/sensor.h"

namespace orbslam {
namespace {

/// Goes part of the way to a medium brightness, as automatic exposure does.
double ExposureGain(const cv::Mat& bgr) {
  constexpr double kWanted = 115, kShare = 0.6;
  const cv::Scalar mean = cv::mean(bgr);
  const double brightness = std::max(1.0, 0.114 * mean[0] + 0.587 * mean[1] + 0.299 * mean[2]);
  return std::clamp(std::pow(kWanted / brightness, kShare), 0.6, 1.8);
}

/// Of the gain, an eighth of a grey level's fixed point.
std::array<int, 256> GainTable(double gain) {
  std::array<int, 256> table;
  for (int i = 0; i < 256; ++i) {
    const double bright = gain * i,
                 soft = bright > 220 ? 220 + (bright - 220) * 0.5 : bright;  // a soft shoulder
    table[i] = static_cast<int>(std::lround(8 * std::min(soft, 255.0)));
  }
  return table;
}

}  // namespace

void DistortColor(const SensorEffects& effects, double drift, Rng* rng, cv::Mat* bgr) {
  constexpr double kBlurPx = 0.55;
  constexpr float kNoise = 2.0f * 8,
                  kBrightNoise = 1.0f * 8;  // dark: the first, bright: with the second on top
  if (effects.image_blur) cv::GaussianBlur(*bgr, *bgr, {3, 3}, kBlurPx);
  if (!effects.exposure && !effects.image_noise) return;
  const std::array<int, 256> gained = GainTable(effects.exposure ? drift * ExposureGain(*bgr) : 1);
  NormalStream normal(rng);
  for (int v = 0; v < bgr->rows; ++v) {
    auto* value = bgr->ptr<uint8_t>(v);
    for (int i = 0; i < 3 * bgr->cols; ++i) {
      int eighths = gained[value[i]];
      if (effects.image_noise) {
        const float sigma = kNoise + kBrightNoise * static_cast<float>(eighths) / 2040.0f;
        eighths += static_cast<int>(sigma * normal.Next());
      }
      value[i] = cv::saturate_cast<uint8_t>((eighths + 4) >> 3);
    }
  }
}

}  // namespace orbslam
