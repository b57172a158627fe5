// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "noise.h"

namespace orbslam {
namespace {

constexpr int kFixedBits = 4;

int Texels(double length_m, double texels_per_metre) {
  return std::max(4, static_cast<int>(std::lround(length_m * texels_per_metre)));
}

}  // namespace

cv::Scalar FromHsv(double hue, double saturation, double value) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + 6 * hue, 6.0);
    return 255 * value * (1 - saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(1), channel(3), channel(5)};
}

cv::Scalar RandomColor(double min_value, double max_value, double max_saturation, Rng* rng) {
  const double hue = rng->Uniform(), saturation = rng->Uniform(0, max_saturation);
  return FromHsv(hue, saturation, rng->Uniform(min_value, max_value));
}

std::string RandomWord(Rng* rng) {
  constexpr std::array kSyllables = {"ro",  "ta",   "men", "vis", "o",   "gra", "ti",  "on",
                                     "le",  "mo",   "del", "ka",  "sen", "sor", "al",  "pha",
                                     "net", "work", "in",  "ter", "po",  "se",  "map", "sta"};
  std::string word;
  for (uint32_t left = 1 + rng->Below(3); left > 0; --left) {
    word += kSyllables[rng->Below(static_cast<uint32_t>(kSyllables.size()))];
  }
  if (rng->Below(5) == 0) word[0] = static_cast<char>(word[0] - 'a' + 'A');
  return word;
}

Canvas::Canvas(double width_m, double height_m, double texels_per_metre, uint64_t seed)
    : width_m_(width_m),
      height_m_(height_m),
      density_(texels_per_metre),
      rng_(seed),
      image_(Texels(height_m, texels_per_metre), Texels(width_m, texels_per_metre), CV_8UC3,
             cv::Scalar::all(255)),
      scale_x_(image_.cols / width_m),
      scale_y_(image_.rows / height_m) {}

cv::Point Canvas::ToFixed(cv::Point2d point) const {
  const cv::Point2d texel = ToTexel(point);
  constexpr double kOne = 1 << kFixedBits;
  return {static_cast<int>(std::lround((texel.x - 0.5) * kOne)),
          static_cast<int>(std::lround((texel.y - 0.5) * kOne))};
}

int Canvas::StrokeTexels(double stroke) const {
  return std::max(1, static_cast<int>(std::lround(stroke * scale_x_)));
}

cv::Rect Canvas::ToTexels(const cv::Rect2d& area) const {
  const cv::Point2d a = ToTexel(area.tl()), b = ToTexel(area.br());
  const auto left = static_cast<int>(std::lround(a.x)), top = static_cast<int>(std::lround(a.y));
  const int width = std::max(1, static_cast<int>(std::lround(b.x)) - left);
  const int height = std::max(1, static_cast<int>(std::lround(b.y)) - top);
  return cv::Rect(left, top, width, height) & cv::Rect({}, image_.size());
}

void Canvas::Fill(const cv::Rect2d& area, const cv::Scalar& bgr) { image_(ToTexels(area)).setTo(bgr); }

void Canvas::Polygon(const std::vector<cv::Point2d>& corners, const cv::Scalar& bgr) {
  std::vector<cv::Point> points;
  for (const cv::Point2d& corner : corners) points.push_back(ToFixed(corner));
  cv::fillPoly(image_, std::vector<std::vector<cv::Point>>{points}, bgr, cv::LINE_AA, kFixedBits);
}

void Canvas::Disc(cv::Point2d middle, double radius, const cv::Scalar& bgr) {
  const auto texels = static_cast<int>(std::lround(radius * scale_x_ * (1 << kFixedBits)));
  cv::circle(image_, ToFixed(middle), std::max(1, texels), bgr, cv::FILLED, cv::LINE_AA, kFixedBits);
}

void Canvas::Ring(cv::Point2d middle, double radius, double stroke, const cv::Scalar& bgr) {
  const auto texels = static_cast<int>(std::lround(radius * scale_x_ * (1 << kFixedBits)));
  cv::circle(image_, ToFixed(middle), std::max(1, texels), bgr, StrokeTexels(stroke), cv::LINE_AA,
             kFixedBits);
}

void Canvas::Line(cv::Point2d from, cv::Point2d to, double stroke, const cv::Scalar& bgr) {
  cv::line(image_, ToFixed(from), ToFixed(to), bgr, StrokeTexels(stroke), cv::LINE_AA, kFixedBits);
}

double Canvas::Text(const std::string& text, cv::Point2d left_end, double letter_height,
                    const cv::Scalar& bgr, bool bold) {
  constexpr double kTexelsAtScaleOne = 21;  // height of a capital letter of Hershey's simplex
  const double scale = letter_height * scale_y_ / kTexelsAtScaleOne;
  const int font = bold ? cv::FONT_HERSHEY_TRIPLEX : cv::FONT_HERSHEY_SIMPLEX;
  const int stroke = std::max(1, static_cast<int>(std::lround((bold ? 1.8 : 1.2) * scale)));
  const cv::Point2d at = ToTexel(left_end);
  cv::putText(image_, text, {static_cast<int>(at.x), static_cast<int>(at.y)}, font, scale, bgr, stroke,
              cv::LINE_AA);
  int below = 0;
  return cv::getTextSize(text, font, scale, stroke, &below).width / scale_x_;
}

void Canvas::Paragraph(const cv::Rect2d& area, double letter_height, const cv::Scalar& bgr) {
  constexpr double kLeast = 5;  // texels, for letters
  const bool as_dashes = letter_height * scale_y_ < kLeast;
  for (double y = area.y + letter_height; y <= area.br().y; y += 1.8 * letter_height) {
    const double line_end = area.x + area.width * rng_.Uniform(0.55, 1.0);
    for (double x = area.x; x < line_end;) {
      const std::string word = RandomWord(&rng_);
      const double width = 0.85 * letter_height * static_cast<double>(word.size());
      if (x + width > area.br().x) break;
      if (as_dashes) {
        Fill({x, y - 0.8 * letter_height, width, 0.7 * letter_height}, bgr);
        x += width + 0.6 * letter_height;
      } else {
        x += Text(word, {x, y}, letter_height, bgr) + 0.6 * letter_height;
      }
    }
  }
}

void Canvas::Roughen(double strength, double coarsest, double smoothness) {
  const cv::Mat noise =
      FractalNoise(image_.size(), std::max(1, static_cast<int>(coarsest * scale_x_)), smoothness, &rng_);
  const auto factor = static_cast<float>(strength * 256);
  for (int y = 0; y < image_.rows; ++y) {
    const auto* n = noise.ptr<float>(y);
    auto* pixel = image_.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image_.cols; ++x) {
      const int gain = std::max(0, 256 + static_cast<int>(factor * n[x]));
      for (int c = 0; c < 3; ++c) pixel[x][c] = cv::saturate_cast<uint8_t>(pixel[x][c] * gain >> 8);
    }
  }
}

void Canvas::Paste(const cv::Mat& bgr, const cv::Rect2d& area) {
  const cv::Rect texels = ToTexels(area);
  if (texels.area() > 0) cv::resize(bgr, image_(texels), texels.size(), 0, 0, cv::INTER_AREA);
}

}  // namespace orbslam
