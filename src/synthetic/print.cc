// SPDX-License-Identifier: GPL-3.0-or-later
#include "print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "noise.h"

namespace orbslam {
namespace {

const cv::Scalar kInk(40, 35, 35);

cv::Rect2d Inset(const cv::Rect2d& area, double margin) {
  return {area.x + margin, area.y + margin, area.width - 2 * margin, area.height - 2 * margin};
}

cv::Rect2d Part(const cv::Rect2d& area, double x, double y, double width, double height) {
  return {area.x + x * area.width, area.y + y * area.height, width * area.width, height * area.height};
}

cv::Vec3b Blend(const cv::Scalar& a, const cv::Scalar& b, double share_of_b, double gain) {
  cv::Vec3b result;
  for (int c = 0; c < 3; ++c) {
    result[c] = cv::saturate_cast<uint8_t>(gain * (a[c] + (b[c] - a[c]) * std::clamp(share_of_b, 0.0, 1.0)));
  }
  return result;
}

void PaintTalk(const cv::Rect2d& area, Canvas* canvas) {
  Rng& rng = canvas->rng();
  const cv::Scalar head = RandomColor(0.3, 0.7, 0.8, &rng);
  canvas->Fill(area, FromHsv(rng.Uniform(), 0.05, 0.95));
  canvas->Fill(Part(area, 0, 0, 1, 0.15), head);
  canvas->Text(RandomWord(&rng) + " " + RandomWord(&rng),
               {area.x + 0.04 * area.width, area.y + 0.1 * area.height}, 0.05 * area.height, {245, 245, 245},
               true);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      const cv::Rect2d cell = Part(area, 0.03 + 0.325 * column, 0.18 + 0.27 * row, 0.29, 0.24);
      canvas->Fill(Part(cell, 0, 0, 1, 0.1), head);
      const uint32_t kind = rng.Below(4);
      if (kind == 0) PaintPhoto(Part(cell, 0, 0.14, 1, 0.84), canvas);
      if (kind == 1) PaintChart(Part(cell, 0, 0.14, 1, 0.84), canvas);
      if (kind > 1) canvas->Paragraph(Part(cell, 0, 0.14, 1, 0.84), 0.014 * area.height, kInk);
    }
  }
}

void PaintLetters(const cv::Rect2d& area, Canvas* canvas) {
  Rng& rng = canvas->rng();
  const double hue = rng.Uniform();
  canvas->Fill(area, FromHsv(hue, 0.7, rng.Uniform(0.35, 0.9)));
  for (int i = 0; i < 7; ++i) {
    const cv::Point2d middle{area.x + area.width * rng.Uniform(0.15, 0.85),
                             area.y + area.height * rng.Uniform(0.35, 0.85)};
    const double radius = rng.Uniform(0.03, 0.14) * area.width;
    canvas->Disc(middle, radius,
                 FromHsv(std::fmod(hue + rng.Uniform(0.2, 0.6), 1.0), 0.6, rng.Uniform(0.4, 1.0)));
  }
  for (int line = 0; line < 2; ++line) {
    canvas->Text(RandomWord(&rng).substr(0, 6),
                 {area.x + 0.07 * area.width, area.y + (0.17 + 0.16 * line) * area.height},
                 0.11 * area.height, {240, 245, 245}, true);
  }
  canvas->Paragraph(Part(area, 0.08, 0.86, 0.84, 0.11), 0.022 * area.height, {235, 240, 240});
}

/// Boxes with words, joined by arrows.
void PaintDiagram(const cv::Rect2d& area, double stroke, Canvas* canvas) {
  Rng& rng = canvas->rng();
  std::vector<cv::Point2d> middles;
  for (int i = 0; i < 6; ++i) {
    const double column = i % 3, row = i / 3;
    middles.emplace_back(area.x + area.width * (0.18 + 0.32 * column + rng.Uniform(-0.04, 0.04)),
                         area.y + area.height * (0.28 + 0.42 * row + rng.Uniform(-0.08, 0.08)));
  }
  for (size_t i = 0; i + 1 < middles.size(); ++i) canvas->Line(middles[i], middles[i + 1], stroke, kInk);
  for (const cv::Point2d& middle : middles) {
    const cv::Scalar edge = RandomColor(0.2, 0.6, 0.9, &rng);
    const cv::Rect2d box(middle.x - 0.11 * area.width, middle.y - 0.1 * area.height, 0.22 * area.width,
                         0.2 * area.height);
    canvas->Fill(box, edge);
    canvas->Fill(Inset(box, stroke), {235, 240, 240});
    canvas->Text(RandomWord(&rng).substr(0, 5), {box.x + 0.02 * area.width, middle.y + 0.03 * area.height},
                 0.07 * area.height, edge);
  }
}

}  // namespace

void PaintPhoto(const cv::Rect2d& area, Canvas* canvas) {
  Rng& rng = canvas->rng();
  const double density = 0.6 * canvas->texels_per_metre();
  const cv::Size size(std::max(8, static_cast<int>(area.width * density)),
                      std::max(8, static_cast<int>(area.height * density)));
  const cv::Mat ridge = FractalNoise({size.width, 1}, size.width / 2, 0.4, &rng);
  const cv::Mat detail = FractalNoise(size, size.width / 4, 0.1, &rng),
                clouds = FractalNoise(size, size.width / 3, 0.45, &rng);
  const cv::Scalar sky = FromHsv(0.58 + rng.Uniform(-0.08, 0.08), 0.5, 0.9), cloud(245, 245, 250);
  const cv::Scalar dark = FromHsv(rng.Uniform(), 0.5, 0.18),
                   bright = FromHsv(rng.Uniform(0.05, 0.4), 0.55, 0.75);
  const double horizon = rng.Uniform(0.3, 0.6);
  cv::Mat photo(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double height = static_cast<double>(y) / size.height;
      const bool is_sky = height < horizon + 0.09 * ridge.at<float>(0, x);
      photo.at<cv::Vec3b>(y, x) =
          is_sky ? Blend(sky, cloud, 0.4 + 0.5 * clouds.at<float>(y, x), 0.85 + 0.2 * height)
                 : Blend(dark, bright, 0.45 + 0.38 * detail.at<float>(y, x),
                         0.7 + 0.4 * height + 0.1 * clouds.at<float>(y, x));
    }
  }
  canvas->Paste(photo, area);
}

void PaintChart(const cv::Rect2d& area, Canvas* canvas) {
  Rng& rng = canvas->rng();
  canvas->Fill(area, {245, 245, 245});
  const double stroke = 0.012 * area.height;
  canvas->Line({area.x + 0.1 * area.width, area.y + 0.05 * area.height},
               {area.x + 0.1 * area.width, area.y + 0.9 * area.height}, stroke, kInk);
  canvas->Line({area.x + 0.1 * area.width, area.y + 0.9 * area.height},
               {area.x + 0.95 * area.width, area.y + 0.9 * area.height}, stroke, kInk);
  const bool bars = rng.Below(2) == 0;
  for (int series = 0; series < (bars ? 1 : 3); ++series) {
    const cv::Scalar color = RandomColor(0.4, 0.9, 1.0, &rng);
    double level = rng.Uniform(0.2, 0.8);
    for (int i = 0; i < 9; ++i) {
      const double last = level;
      level = std::clamp(level + rng.Uniform(-0.25, 0.25), 0.05, 0.85);
      const double x = area.x + area.width * (0.13 + 0.09 * i), bottom = area.y + 0.9 * area.height;
      if (bars) {
        canvas->Fill({x, bottom - level * area.height, 0.06 * area.width, level * area.height}, color);
      } else {
        canvas->Line({x, bottom - last * area.height}, {x + 0.09 * area.width, bottom - level * area.height},
                     2 * stroke, color);
      }
    }
  }
}

void PaintPage(const cv::Rect2d& area, Canvas* canvas) {
  Rng& rng = canvas->rng();
  canvas->Fill(area, FromHsv(0.12, rng.Uniform(0, 0.06), rng.Uniform(0.88, 0.97)));
  const cv::Rect2d text = Inset(area, 0.09 * area.width);
  canvas->Text(RandomWord(&rng), {text.x, text.y + 0.05 * text.height}, 0.045 * text.height, kInk, true);
  double top = 0.09;
  if (rng.Below(3) == 0) {
    const cv::Rect2d figure = Part(text, 0.05, top, 0.9, 0.33);
    if (rng.Below(2))
      PaintPhoto(figure, canvas);
    else
      PaintChart(figure, canvas);
    top = 0.46;
  }
  canvas->Paragraph(Part(text, 0, top, 1, rng.Uniform(0.75, 0.97) - top),
                    rng.Uniform(0.014, 0.022) * area.height, kInk);
}

void PaintPoster(const cv::Rect2d& area, Canvas* canvas) {
  Rng& rng = canvas->rng();
  canvas->Fill({area.x - 0.006, area.y - 0.004, area.width + 0.014, area.height + 0.016},
               {95, 100, 105});  // its shadow
  switch (rng.Below(4)) {
    case 0:
      canvas->Fill(area, {235, 238, 240});
      PaintPhoto(Part(area, 0.05, 0.04, 0.9, 0.78), canvas);
      canvas->Text(RandomWord(&rng), {area.x + 0.06 * area.width, area.y + 0.92 * area.height},
                   0.05 * area.height, kInk, true);
      return;
    case 1:
      return PaintTalk(area, canvas);
    case 2:
      return PaintLetters(area, canvas);
    default:
      canvas->Fill(area, {225, 235, 240});
      PaintDiagram(Part(area, 0.03, 0.12, 0.94, 0.5), 0.004, canvas);
      canvas->Text(RandomWord(&rng), {area.x + 0.06 * area.width, area.y + 0.09 * area.height},
                   0.05 * area.height, kInk, true);
      canvas->Paragraph(Part(area, 0.06, 0.65, 0.88, 0.31), 0.018 * area.height, kInk);
  }
}

void PaintCalendar(const cv::Rect2d& area, Canvas* canvas) {
  canvas->Fill(area, {240, 240, 240});
  PaintPhoto(Part(area, 0, 0, 1, 0.5), canvas);
  for (int i = 0; i < 31; ++i) {
    const cv::Point2d at{area.x + area.width * (0.06 + 0.13 * (i % 7)),
                         area.y + area.height * (0.62 + 0.085 * (i / 7))};
    canvas->Text(std::to_string(i + 1), at, 0.035 * area.height, i % 7 == 6 ? cv::Scalar(40, 40, 200) : kInk);
  }
}

void PaintWhiteboard(Canvas* canvas) {
  Rng& rng = canvas->rng();
  const double w = canvas->width(), h = canvas->height();
  canvas->Fill(canvas->Whole(), {170, 172, 172});
  canvas->Fill(Inset(canvas->Whole(), 0.02), {238, 240, 240});
  PaintDiagram({0.05 * w, 0.1 * h, 0.5 * w, 0.6 * h}, 0.006, canvas);
  for (int i = 0; i < 6; ++i) {
    const cv::Scalar pen = FromHsv(std::array{0.0, 0.62, 0.35}[rng.Below(3)], 0.8, 0.6);
    canvas->Text(RandomWord(&rng) + " = " + std::to_string(rng.Below(90)) + " x",
                 {0.6 * w, h * (0.18 + 0.13 * i)}, 0.045 * h, pen);
  }
  canvas->Line({0.58 * w, 0.1 * h}, {0.58 * w, 0.9 * h}, 0.006, {60, 60, 160});
}

void PaintScreen(Canvas* canvas) {
  Rng& rng = canvas->rng();
  const double w = canvas->width(), h = canvas->height();
  PaintPhoto(canvas->Whole(), canvas);
  canvas->Fill({0, 0.95 * h, w, 0.05 * h}, {60, 50, 45});
  for (int pane = 0; pane < 2; ++pane) {
    const bool dark = rng.Below(2) == 0;
    const cv::Rect2d area(w * (0.03 + 0.46 * pane + rng.Uniform(0, 0.04)), h * rng.Uniform(0.04, 0.12),
                          0.44 * w, h * rng.Uniform(0.6, 0.8));
    canvas->Fill(area, dark ? cv::Scalar(45, 35, 35) : cv::Scalar(240, 240, 240));
    canvas->Fill({area.x, area.y, area.width, 0.04 * h}, {150, 130, 115});
    const double letter = 0.018 * h;
    for (double y = area.y + 0.08 * h; y < area.br().y - letter; y += 1.9 * letter) {
      const double indent = 0.02 * w * rng.Below(4);
      const cv::Scalar ink = dark ? RandomColor(0.6, 1.0, 0.6, &rng) : RandomColor(0.1, 0.5, 0.8, &rng);
      canvas->Paragraph(
          {area.x + 0.01 * w + indent, y - letter, area.width - 0.02 * w - indent, 1.2 * letter}, letter,
          ink);
    }
  }
}

void PaintKeyboard(Canvas* canvas) {
  Rng& rng = canvas->rng();
  const bool dark = rng.Below(2) == 0;
  const cv::Scalar body = dark ? cv::Scalar(38, 36, 36) : cv::Scalar(200, 205, 205);
  const cv::Scalar key = dark ? cv::Scalar(62, 60, 60) : cv::Scalar(228, 230, 230),
                   ink = dark ? cv::Scalar(210, 210, 210) : kInk;
  canvas->Fill(canvas->Whole(), body);
  const double pitch_x = (canvas->width() - 0.02) / 20, pitch_y = (canvas->height() - 0.02) / 6;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 20; ++column) {
      if (column == 15 || (row == 0 && column % 5 == 1)) continue;
      const cv::Rect2d cap(0.01 + pitch_x * column, 0.01 + pitch_y * row, 0.86 * pitch_x, 0.84 * pitch_y);
      canvas->Fill(cap, key);
      canvas->Fill({cap.x + 0.3 * cap.width, cap.y + 0.25 * cap.height, 0.35 * cap.width, 0.4 * cap.height},
                   ink);
    }
  }
}

void PaintBookBacks(Canvas* canvas) {
  Rng& rng = canvas->rng();
  const double w = canvas->width(), h = canvas->height();
  canvas->Fill(canvas->Whole(), {25, 28, 32});
  for (double x = 0.002; x < w - 0.015;) {
    const double width = std::min(rng.Uniform(0.015, 0.055), w - x), height = h * rng.Uniform(0.68, 0.98);
    const cv::Rect2d back(x, h - height, width - 0.002, height);
    const double value = rng.Uniform(0.2, 0.95);
    const cv::Scalar cover = FromHsv(rng.Uniform(), rng.Uniform(0.1, 0.8), value),
                     ink = value > 0.6 ? kInk : cv::Scalar(225, 230, 230);
    canvas->Fill(back, cover);
    canvas->Fill({back.x, back.y, 0.2 * back.width, back.height}, cover * 0.8);
    for (double y = 0.1; y < 0.75; y += 0.045) {  // a title that runs down the back
      if (rng.Below(4)) canvas->Fill(Part(back, 0.32, y, rng.Uniform(0.2, 0.5), 0.03), ink);
    }
    canvas->Fill(Part(back, 0, rng.Uniform(0.8, 0.86), 1, 0.03), ink);
    if (rng.Below(3) == 0) canvas->Fill(Part(back, 0.2, 0.88, 0.7, 0.08), {240, 240, 240});
    x += width + (rng.Below(14) == 0 ? rng.Uniform(0.03, 0.1) : 0);
  }
  canvas->Roughen(0.04, 0.05, 0.2);
}

void PaintCarton(Canvas* canvas) {
  Rng& rng = canvas->rng();
  const double w = canvas->width(), h = canvas->height();
  canvas->Fill(canvas->Whole(), FromHsv(0.08, 0.45, rng.Uniform(0.55, 0.75)));
  canvas->Roughen(0.05, 0.1, 0.2);
  canvas->Fill({0, 0.46 * h, w, 0.05}, FromHsv(0.1, 0.3, 0.8));
  canvas->Text(RandomWord(&rng), {0.08 * w, 0.35 * h}, 0.16 * h, {50, 60, 80}, true);
  PaintPage({0.55 * w, 0.55 * h, 0.35 * w, 0.36 * h}, canvas);
  for (int i = 0; i < 14; ++i)
    canvas->Fill({0.08 * w + 0.02 * w * i, 0.68 * h, rng.Uniform(0.004, 0.016) * w, 0.16 * h}, kInk);
}

}  // namespace orbslam
