// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "figure_cloth.h"

namespace orbslam {
namespace {

constexpr int kWidthPx = 512, kHeightPx = 256, kMiddlePx = kWidthPx / 2;
constexpr int kSubpixel = 16, kShift = 4;

/// A filled, anti-aliased ellipse about a place in the face; pixels.
void Spot(double x, double y, double half_width, double half_height, const cv::Scalar& bgr, cv::Mat* face) {
  const auto fixed = [](double value) { return static_cast<int>(std::lround(value * kSubpixel)); };
  cv::ellipse(*face, {fixed(x), fixed(y)}, {fixed(half_width), fixed(half_height)}, 0, 0, 360, bgr,
              cv::FILLED, cv::LINE_AA, kShift);
}

/// Adds a soft shade (grey levels) about a place.
void Shade(double x, double y, double half_width, double half_height, const cv::Scalar& levels,
           cv::Mat* face) {
  constexpr double kReach = 2.7;  // half-widths; beyond it the shade is below a grey level
  const cv::Rect near(cv::Point2d(x - kReach * half_width, y - kReach * half_height),
                      cv::Point2d(x + kReach * half_width, y + kReach * half_height));
  const cv::Rect area = near & cv::Rect({}, face->size());
  for (int row = area.y; row < area.br().y; ++row) {
    for (int col = area.x; col < area.br().x; ++col) {
      const double dx = (col - x) / half_width, dy = (row - y) / half_height;
      const double weight = std::exp(-dx * dx - dy * dy);
      auto& pixel = face->at<cv::Vec3b>(row, col);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<uint8_t>(pixel[c] + weight * levels[c]);
    }
  }
}

void Eye(double x, double y, const cv::Scalar& skin, const cv::Scalar& iris, cv::Mat* face) {
  Spot(x, y, 14, 6.5, 0.45 * skin, face);  // lashes and lids
  Spot(x, y + 0.6, 12.5, 5.2, {225, 228, 230}, face);
  Spot(x, y, 5.2, 5.2, iris, face);
  Spot(x, y, 2.5, 2.5, {15, 12, 12}, face);
  Spot(x - 1.6, y - 1.8, 1.2, 1.2, {250, 250, 250}, face);
}

}  // namespace

Picture PaintFace(const FaceRows& rows, const cv::Scalar& skin_bgr, const cv::Scalar& hair_bgr, Rng* rng) {
  auto face = std::make_shared<cv::Mat>();
  cv::resize(*PaintSkin(skin_bgr, rng), *face, {kWidthPx, kHeightPx});
  const auto row = [](double share) { return share * kHeightPx; };
  const double apart = 30;  // pixels from the middle to an eye: 64 mm between the pupils
  const cv::Scalar dark(-38, -42, -45);
  for (const double side : {-1.0, 1.0}) {
    const double x = kMiddlePx + side * apart;
    Shade(x, row(rows.eyes), 22, 13, 0.8 * dark, face.get());  // sockets
    Shade(x + side * 14, row(0.5 * rows.nose + 0.5 * rows.mouth), 24, 22, {-8, -8, 14},
          face.get());                                                            // cheeks
    Shade(kMiddlePx + side * 11, row(rows.nose), 7, 14, 0.6 * dark, face.get());  // beside the nose
    Eye(x, row(rows.eyes), skin_bgr, {60 + 40 * rng->Uniform(), 70, 75}, face.get());
    for (int i = -9; i <= 9; ++i) {
      const double arch = 0.05 * i * i;
      Spot(x + 2 * i, row(rows.brows) + arch, 3, 3.2, 0.8 * hair_bgr, face.get());
    }
    Spot(kMiddlePx + side * 6, row(rows.nose) + 12, 4, 2.2, 0.4 * skin_bgr, face.get());  // nostrils
  }
  const cv::Scalar lips(0.55 * skin_bgr[0], 0.5 * skin_bgr[1], 0.82 * skin_bgr[2]);
  Spot(kMiddlePx, row(rows.mouth), 22, 7, lips, face.get());
  Spot(kMiddlePx, row(rows.mouth), 22, 1.3, 0.4 * lips, face.get());
  Shade(kMiddlePx, row(rows.mouth) + 14, 18, 6, 0.5 * dark, face.get());
  if (rng->Below(2) == 0) {  // a short beard
    Shade(kMiddlePx, row(rows.mouth) + 18, 66, 22, {-60, -65, -75}, face.get());
    Spot(kMiddlePx, row(rows.mouth), 18, 5, lips, face.get());
    Spot(kMiddlePx, row(rows.mouth), 18, 1.2, 0.4 * lips, face.get());
  }
  return face;
}

}  // namespace orbslam
