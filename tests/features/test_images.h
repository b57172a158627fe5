// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "orbslam/features/orb_extractor.h"
#include "orbslam/util/random.h"

namespace orbslam {

/// The pixel of its level's image that a keypoint was found at: levels are resized with the centres of pixels
/// mapped, to sizes rounded to whole pixels.
inline cv::Point2d LevelPixel(const OrbKeypoint& k, cv::Size image, double scale) {
  const cv::Point2d size(std::round(image.width / scale), std::round(image.height / scale));
  return {(k.u + 0.5) * size.x / image.width - 0.5, (k.v + 0.5) * size.y / image.height - 0.5};
}

/// CV_8UC1 of independent uniform grey values.
inline cv::Mat NoiseImage(cv::Size size, uint64_t seed) {
  Rng rng(seed);
  cv::Mat image(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) image.at<uint8_t>(y, x) = static_cast<uint8_t>(rng.Below(256));
  }
  return image;
}

/// Overlapping boxes and discs of random grey on a plain ground, inside `textured`, softened like a lens
/// does.
inline cv::Mat ShapesImage(cv::Size size, uint64_t seed, cv::Rect textured = {}) {
  Rng rng(seed);
  if (textured.empty()) textured = {0, 0, size.width, size.height};
  cv::Mat image(size, CV_8UC1, cv::Scalar(128));
  cv::Mat inside = image(textured);
  for (int i = 0; i < textured.area() / 400; ++i) {
    const cv::Point center(static_cast<int>(rng.Below(textured.width)),
                           static_cast<int>(rng.Below(textured.height)));
    const int half = static_cast<int>(2 + rng.Below(14));
    const cv::Scalar grey(rng.Below(256));
    if (rng.Below(2) == 0) {
      cv::circle(inside, center, half, grey, cv::FILLED);
    } else {
      cv::rectangle(inside, center - cv::Point(half, half), center + cv::Point(half, 2 * half), grey,
                    cv::FILLED);
    }
  }
  cv::GaussianBlur(image, image, {3, 3}, 0.7);
  return image;
}

}  // namespace orbslam
