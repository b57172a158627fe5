// SPDX-License-Identifier: GPL-3.0-or-later
#include "props_paint.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

cv::Scalar Mix(const cv::Scalar& a, const cv::Scalar& b, double weight_b) { return a + weight_b * (b - a); }

int Draw(int low, int high, Rng* rng) {
  return low + static_cast<int>(rng->Below(static_cast<uint32_t>(high - low)));
}

cv::Scalar Bright(Rng* rng) {
  const double blue = rng->Uniform(40, 240), green = rng->Uniform(40, 240);
  return {blue, green, rng->Uniform(40, 240)};
}

/// Lines of words, as bars of uneven length and height.
void Lines(const cv::Rect& area, int line_px, const cv::Scalar& ink, Rng* rng, cv::Mat* picture) {
  for (int y = area.y; y + line_px <= area.br().y; y += 2 * line_px) {
    for (int x = area.x; x < area.br().x;) {
      const int width = std::min(Draw(line_px, 5 * line_px, rng), area.br().x - x);
      const int height = std::max(1, line_px - Draw(0, 2, rng));
      cv::rectangle(*picture, cv::Rect(x, y, width, height), ink, cv::FILLED);
      x += width + line_px;
    }
  }
}

/// Grain of the paper or the wood, grey levels.
void Roughen(int amplitude, Rng* rng, cv::Mat* picture) {
  for (auto& pixel : cv::Mat_<cv::Vec3b>(*picture)) {
    const int change = Draw(-amplitude, amplitude + 1, rng);
    for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<uint8_t>(pixel[c] + change);
  }
}

}  // namespace

Picture PaintCarton(Rng* rng) {
  auto carton = std::make_shared<cv::Mat>(224, 320, CV_8UC3, cv::Scalar(105, 150, 188));
  for (int y = 0; y < carton->rows; y += 3) {
    cv::line(*carton, {0, y}, {carton->cols, y}, cv::Scalar(98, 141, 178), 1);
  }
  const int tape = carton->cols / 2;
  cv::rectangle(*carton, cv::Rect(tape - 20, 0, 40, carton->rows), cv::Scalar(130, 175, 205), cv::FILLED);
  const cv::Rect sheet(Draw(14, 40, rng), Draw(20, 60, rng), 92, 110);
  cv::rectangle(*carton, sheet, cv::Scalar(240, 240, 240), cv::FILLED);
  Lines(sheet - cv::Size(16, 60) + cv::Point(8, 8), 4, {30, 30, 30}, rng, carton.get());
  for (int x = sheet.x + 8; x < sheet.br().x - 8; x += Draw(3, 8, rng)) {
    cv::rectangle(*carton, cv::Rect(x, sheet.br().y - 40, Draw(1, 4, rng), 30), cv::Scalar(20, 20, 20),
                  cv::FILLED);
  }
  cv::putText(*carton, rng->Below(2) == 0 ? "FRAGILE" : "THIS SIDE UP", {196, 90}, cv::FONT_HERSHEY_DUPLEX,
              0.55, {30, 30, 150}, 2, cv::LINE_AA);
  for (int i = 0; i < 2; ++i) {
    cv::arrowedLine(*carton, {220 + 50 * i, 190}, {220 + 50 * i, 120}, cv::Scalar(40, 50, 60), 7, cv::LINE_AA,
                    0, 0.4);
  }
  Roughen(9, rng, carton.get());
  return carton;
}

Picture PaintWood(Rng* rng) {
  auto wood = std::make_shared<cv::Mat>(256, 256, CV_8UC3);
  const cv::Scalar light(120, 165, 205), dark(60, 95, 135);
  for (int y = 0; y < wood->rows; ++y) {
    cv::line(*wood, {0, y}, {wood->cols, y}, Mix(light, dark, rng->Uniform(0, 0.6)), 1);
  }
  for (int i = 0; i < 14; ++i) {
    const cv::Point knot(Draw(0, 256, rng), Draw(0, 256, rng));
    cv::ellipse(*wood, knot, {Draw(6, 26, rng), Draw(2, 6, rng)}, 0, 0, 360, Mix(light, dark, 0.9), 2,
                cv::LINE_AA);
  }
  Roughen(10, rng, wood.get());
  return wood;
}

Picture PaintNotices(Rng* rng) {
  auto board = std::make_shared<cv::Mat>(640, 720, CV_8UC3, cv::Scalar(70, 110, 150));
  Roughen(30, rng, board.get());
  for (int i = 0; i < 46; ++i) {
    const cv::Rect sheet(Draw(-20, 660, rng), Draw(-20, 590, rng), Draw(50, 170, rng), Draw(50, 150, rng));
    const bool dark = rng->Below(4) == 0;
    const cv::Scalar paper = dark ? Mix(Bright(rng), {0, 0, 0}, 0.5) : Mix(Bright(rng), {255, 255, 255}, 0.7);
    cv::rectangle(*board, sheet, paper, cv::FILLED);
    cv::rectangle(*board, sheet, Mix(paper, {0, 0, 0}, 0.5), 1);
    const cv::Scalar ink = dark ? cv::Scalar(230, 230, 230) : cv::Scalar(35, 30, 30);
    const int heading = Draw(6, 13, rng);
    Lines({sheet.x + 8, sheet.y + 8, sheet.width - 16, 2 * heading}, heading, ink, rng, board.get());
    if (sheet.width > 60) {
      const cv::Rect figure(sheet.x + 10, sheet.y + 34, sheet.width / 3, sheet.height / 3);
      cv::rectangle(*board, figure, Bright(rng), cv::FILLED);
    }
    const int top = sheet.y + 40 + sheet.height / 3;
    Lines({sheet.x + 8, top, sheet.width - 16, sheet.br().y - top - 8}, 4, ink, rng, board.get());
    cv::circle(*board, {sheet.x + sheet.width / 2, sheet.y + 5}, 4, Bright(rng), cv::FILLED, cv::LINE_AA);
  }
  cv::rectangle(*board, cv::Rect({}, board->size()), cv::Scalar(90, 90, 90), 12);
  return board;
}

Picture PaintFiles(Rng* rng) {
  auto files = std::make_shared<cv::Mat>(160, 320, CV_8UC3, cv::Scalar(40, 40, 40));
  for (int x = 0; x < files->cols;) {
    const int width = Draw(18, 38, rng), top = Draw(0, 30, rng);
    const cv::Rect back(x, top, width - 2, files->rows - top);
    cv::rectangle(*files, back, Mix(Bright(rng), {60, 60, 60}, 0.4), cv::FILLED);
    cv::rectangle(*files, cv::Rect(x + 3, top + 18, std::max(2, width - 9), 44), cv::Scalar(235, 235, 235),
                  cv::FILLED);
    Lines({x + 5, top + 24, std::max(2, width - 13), 32}, 3, {30, 30, 30}, rng, files.get());
    cv::circle(*files, {x + width / 2, files->rows - 24}, 5, cv::Scalar(25, 25, 25), cv::FILLED, cv::LINE_AA);
    x += width;
  }
  return files;
}

}  // namespace orbslam
