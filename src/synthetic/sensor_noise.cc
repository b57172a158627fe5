// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/sensor_noise.h"

#include <cmath>

#include "orbslam/camera/depth_model.h"

namespace orbslam {
namespace {

/// Nearly normal, mean 0, standard deviation 1: the sum of the four 16-bit quarters of one draw (Irwin-Hall).
/// Half a million of these a frame: logarithms and cosines would cost more than the picture.
float QuickGaussian(Rng* rng) {
  const uint64_t bits = (*rng)();
  const auto sum =
      static_cast<float>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48));
  constexpr float kMean = 2.0f * 65535.0f, kSigma = 65536.0f * 0.57735027f;  // of four: sqrt(4 / 12)
  return (sum - kMean) / kSigma;
}

}  // namespace

void AddKinectNoise(Rng* rng, cv::Mat* depth_m) {
  constexpr float kMinM = 0.5f, kMaxM = 8.0f, kUnitsPerMetre = 5000.0f;
  for (float& depth : cv::Mat_<float>(*depth_m)) {
    const float error = QuickGaussian(rng) * static_cast<float>(DepthModel::SigmaM(depth));
    const bool in_range = depth >= kMinM && depth <= kMaxM;
    depth = in_range ? std::nearbyint((depth + error) * kUnitsPerMetre) / kUnitsPerMetre : 0.0f;
  }
}

void AddImageNoise(double sigma, Rng* rng, cv::Mat* bgr) {
  for (cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(*bgr)) {
    const auto error = static_cast<int>(std::lrintf(static_cast<float>(sigma) * QuickGaussian(rng)));
    for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<uint8_t>(pixel[c] + error);
  }
}

}  // namespace orbslam
