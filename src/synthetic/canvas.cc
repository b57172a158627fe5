// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "orbslam/synthetic/texture.h"

namespace orbslam {
namespace {

int TextureSide(double length_m, double texels_per_metre) {
  constexpr int kStep = Texture::kSideMultiple;
  return kStep * std::max(2, static_cast<int>(std::lround(length_m * texels_per_metre / kStep)));
}

/// A smooth random field around 128, CV_8UC1, whose bumps are cell_texels wide.
cv::Mat SmoothNoise(cv::Size size, int cell_texels, Rng* rng) {
  cv::Mat coarse(size.height / cell_texels + 2, size.width / cell_texels + 2, CV_8UC1), field;
  for (auto& value : cv::Mat_<uint8_t>(coarse)) value = static_cast<uint8_t>(rng->Below(256));
  cv::resize(coarse, field, size, 0, 0, cv::INTER_LINEAR_EXACT);
  return field;
}

}  // namespace

cv::Scalar RandomColor(double lightness, Rng* rng) {
  const auto channel = [&] { return std::clamp(lightness * rng->Uniform(0.6, 1.4), 0.0, 255.0); };
  const double blue = channel(), green = channel(), red = channel();
  return {blue, green, red, 255};
}

Canvas::Canvas(double width_m, double height_m, double texels_per_metre, uint64_t seed)
    : width_m_(width_m),
      height_m_(height_m),
      rng_(seed),
      image_(TextureSide(height_m, texels_per_metre), TextureSide(width_m, texels_per_metre), CV_8UC4) {}

cv::Rect Canvas::ToTexels(const cv::Rect2d& area_m) const {
  const double sx = image_.cols / width_m_, sy = image_.rows / height_m_;
  const auto left = static_cast<int>(std::lround(area_m.x * sx)),
             top = static_cast<int>(std::lround(area_m.y * sy));
  const auto right = static_cast<int>(std::lround(area_m.br().x * sx));
  const auto bottom = static_cast<int>(std::lround(area_m.br().y * sy));
  return cv::Rect(left, top, std::max(1, right - left), std::max(1, bottom - top)) &
         cv::Rect({}, image_.size());
}

void Canvas::Fill(const cv::Rect2d& area_m, const cv::Scalar& bgr) { image_(ToTexels(area_m)).setTo(bgr); }

void Canvas::Write(const cv::Rect2d& area_m, double letter_height_m, const cv::Scalar& ink_bgr) {
  const double h = letter_height_m, w = 0.6 * h, stroke = 0.2 * h;
  for (double y = area_m.y; y + h <= area_m.br().y; y += 1.7 * h) {
    const double line_end = area_m.x + area_m.width * rng_.Uniform(0.6, 1.0);
    for (double x = area_m.x; x + w <= line_end; x += 1.3 * w) {
      if (rng_.Below(6) == 0) continue;  // between words
      const uint32_t strokes = 1 + rng_.Below(31);
      if (strokes & 1) Fill({x, y, stroke, h}, ink_bgr);
      if (strokes & 2) Fill({x + w - stroke, y, stroke, h}, ink_bgr);
      if (strokes & 4) Fill({x, y, w, stroke}, ink_bgr);
      if (strokes & 8) Fill({x, y + 0.4 * h, w, stroke}, ink_bgr);
      if (strokes & 16) Fill({x, y + h - stroke, w, stroke}, ink_bgr);
    }
  }
}

void Canvas::Poster(const cv::Rect2d& area_m) {
  const bool dark = rng_.Below(3) == 0;
  const cv::Scalar ink = RandomColor(dark ? 200 : 45, &rng_);
  const double w = area_m.width, h = area_m.height, margin = 0.06 * std::min(w, h);
  const cv::Point2d inside = area_m.tl() + cv::Point2d(margin, margin);
  Fill({area_m.x - 0.012, area_m.y - 0.012, w + 0.024, h + 0.024}, RandomColor(dark ? 170 : 60, &rng_));
  Fill(area_m, RandomColor(dark ? 60 : 210, &rng_));
  Write({inside, cv::Size2d(w - 2 * margin, 0.2 * h)}, 0.11 * h, ink);
  for (int i = 0; i < 9; ++i) {
    // Braces draw from left to right; the order of a call's arguments would be the compiler's.
    const cv::Point2d corner{rng_.Uniform(0, 0.6) * w + margin, rng_.Uniform(0.22, 0.5) * h};
    const cv::Size2d size{rng_.Uniform(0.05, 0.3) * w, rng_.Uniform(0.05, 0.15) * h};
    Fill({area_m.tl() + corner, size}, RandomColor(rng_.Uniform(30, 220), &rng_));
  }
  Write({inside.x, area_m.y + 0.68 * h, w - 2 * margin, 0.28 * h}, 0.035 * h, ink);
}

void Canvas::Roughen(double strength) {
  cv::Mat noise(image_.size(), CV_16SC1, cv::Scalar(0));
  for (const int cell_texels : {1, 6, 40}) {
    cv::add(noise, SmoothNoise(image_.size(), cell_texels, &rng_), noise, cv::noArray(), CV_16S);
  }
  const auto factor = static_cast<int>(std::lround(strength * 256.0 / 128.0));  // fixed point, 8 bits
  for (int y = 0; y < image_.rows; ++y) {
    const auto* n = noise.ptr<int16_t>(y);
    auto* pixel = image_.ptr<cv::Vec4b>(y);
    for (int x = 0; x < image_.cols; ++x) {
      const int gain = 256 * 256 + (n[x] - 3 * 128) * factor;
      for (int c = 0; c < 3; ++c) pixel[x][c] = cv::saturate_cast<uint8_t>(pixel[x][c] * (gain >> 4) >> 12);
    }
  }
}

void Canvas::Shade(double factor, double edge_darkening) {
  constexpr double kReachM = 0.35;
  const auto light = [&](double distance_m) {
    return 1.0 - edge_darkening * std::exp(-distance_m / kReachM);
  };
  const double texel_x = width_m_ / image_.cols, texel_y = height_m_ / image_.rows;
  std::vector<float> column_light(image_.cols);
  for (int x = 0; x < image_.cols; ++x) {
    column_light[x] = static_cast<float>(factor * light(texel_x * std::min(x, image_.cols - x)));
  }
  for (int y = 0; y < image_.rows; ++y) {
    const auto row_light = static_cast<float>(light(texel_y * std::min(y, image_.rows - y)));
    auto* pixel = image_.ptr<cv::Vec4b>(y);
    for (int x = 0; x < image_.cols; ++x) {
      const auto gain = static_cast<int>(256.0f * row_light * column_light[x]);
      for (int c = 0; c < 3; ++c) pixel[x][c] = cv::saturate_cast<uint8_t>(pixel[x][c] * gain >> 8);
    }
  }
}

}  // namespace orbslam
