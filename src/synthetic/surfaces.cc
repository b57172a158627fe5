// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaces.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "print.h"

namespace orbslam {
namespace {

/// Multiplies by 1 + strength * noise that is stretched along x.
void AddGrain(double strength, const cv::Rect& texels, Canvas* canvas) {
  constexpr int kStretch = 24;
  cv::Mat part = canvas->image()(texels);
  const cv::Mat noise = FractalNoise({part.cols / kStretch + 2, part.rows}, 16, 0.1, &canvas->rng());
  for (int y = 0; y < part.rows; ++y) {
    const auto* n = noise.ptr<float>(y);
    auto* pixel = part.ptr<cv::Vec3b>(y);
    for (int x = 0; x < part.cols; ++x) {
      const float place = static_cast<float>(x) / kStretch, share = place - std::floor(place);
      const auto left = static_cast<int>(place);
      const double gain = 1 + strength * (n[left] * (1 - share) + n[left + 1] * share);
      for (int c = 0; c < 3; ++c) pixel[x][c] = cv::saturate_cast<uint8_t>(pixel[x][c] * gain);
    }
  }
}

}  // namespace

void PaintPlaster(const cv::Scalar& bgr, Canvas* canvas) {
  canvas->Fill(canvas->Whole(), bgr);
  canvas->Roughen(0.012, 0.8, 0.15);
  Rng& rng = canvas->rng();
  for (int i = 0; i < 9; ++i) {  // scratches and heel marks
    const cv::Point2d at{rng.Uniform(0, canvas->width()), canvas->height() * rng.Uniform(0.5, 1.0)};
    const cv::Point2d along{rng.Uniform(-0.07, 0.07), rng.Uniform(-0.03, 0.03)};
    canvas->Line(at, at + along, 0.003, bgr * 0.8);
  }
}

void PaintCarpet(const cv::Scalar& bgr, Canvas* canvas) {
  constexpr double kTileM = 0.5;
  for (double y = 0; y < canvas->height(); y += kTileM) {
    for (double x = 0; x < canvas->width(); x += kTileM) {
      canvas->Fill({x, y, kTileM, kTileM}, bgr * canvas->rng().Uniform(0.93, 1.07));
    }
  }
  canvas->Roughen(0.13, 0.3, 0.0);
  Rng& rng = canvas->rng();
  for (int i = 0; i < 40; ++i) {  // crumbs and stains
    const cv::Point2d at{rng.Uniform(0, canvas->width()), rng.Uniform(0, canvas->height())};
    canvas->Disc(at, rng.Uniform(0.004, 0.015), bgr * rng.Uniform(0.5, 1.6));
  }
}

void PaintParquet(const cv::Scalar& bgr, Canvas* canvas) {
  constexpr double kWidthM = 0.12, kLengthM = 1.1, kJointM = 0.003;
  Rng& rng = canvas->rng();
  const double scale = canvas->texels_per_metre();
  for (double y = 0; y < canvas->height(); y += kWidthM) {
    for (double x = -rng.Uniform(0, kLengthM); x < canvas->width(); x += kLengthM) {
      canvas->Fill({x, y, kLengthM - kJointM, kWidthM - kJointM}, bgr * rng.Uniform(0.75, 1.15));
    }
    const cv::Rect strip(0, static_cast<int>(y * scale), canvas->image().cols,
                         static_cast<int>(kWidthM * scale));
    AddGrain(0.13, strip & cv::Rect({}, canvas->image().size()), canvas);
    canvas->Fill({0, y, canvas->width(), kJointM}, bgr * 0.4);
  }
  canvas->Roughen(0.04, 0.5, 0.1);
}

void PaintWood(const cv::Scalar& bgr, Canvas* canvas) {
  canvas->Fill(canvas->Whole(), bgr);
  AddGrain(0.12, cv::Rect({}, canvas->image().size()), canvas);
  canvas->Roughen(0.03, 0.3, 0.1);
}

void PaintCeiling(Canvas* canvas) {
  constexpr double kTileM = 0.6;
  canvas->Fill(canvas->Whole(), {222, 226, 226});
  canvas->Roughen(0.03, 0.02, 0.0);
  for (double y = 0; y < canvas->height(); y += kTileM)
    canvas->Fill({0, y, canvas->width(), 0.015}, {165, 168, 168});
  for (double x = 0; x < canvas->width(); x += kTileM)
    canvas->Fill({x, 0, 0.015, canvas->height()}, {165, 168, 168});
}

void PaintFabric(const cv::Scalar& bgr, Canvas* canvas) {
  canvas->Fill(canvas->Whole(), bgr);
  canvas->Roughen(0.16, 0.03, 0.0);
}

void PaintDoor(const cv::Scalar& bgr, Canvas* canvas) {
  const double w = canvas->width(), h = canvas->height();
  PaintWood(bgr, canvas);
  canvas->Fill({0.3 * w, 0.12 * h, 0.02 * w, 0.3 * h}, bgr * 0.6);
  canvas->Disc({0.9 * w, 0.53 * h}, 0.03, {150, 150, 150});
  canvas->Fill({0.78 * w, 0.52 * h, 0.13 * w, 0.012 * h}, {175, 175, 175});
  PaintPage({0.35 * w, 0.2 * h, 0.21, 0.297}, canvas);
  canvas->Fill({0.3 * w, 0.1 * h, 0.4 * w, 0.04 * h}, {120, 80, 40});
  canvas->Text("2.017", {0.36 * w, 0.132 * h}, 0.03 * h, {240, 240, 240});
}

void PaintOutdoors(Canvas* canvas) {
  const double w = canvas->width(), h = canvas->height();
  Rng& rng = canvas->rng();
  PaintPhoto(canvas->Whole(), canvas);
  for (int house = 0; house < 3; ++house) {
    const cv::Rect2d wall(w * (0.05 + 0.32 * house), h * rng.Uniform(0.4, 0.55), 0.26 * w, h);
    canvas->Fill(wall, FromHsv(rng.Uniform(0.02, 0.15), 0.25, rng.Uniform(0.75, 0.95)));
    canvas->Polygon({{wall.x - 0.02 * w, wall.y},
                     {wall.x + 0.5 * wall.width, wall.y - 0.14 * h},
                     {wall.br().x + 0.02 * w, wall.y}},
                    FromHsv(0.03, 0.5, rng.Uniform(0.4, 0.6)));
    for (int i = 0; i < 9; ++i) {
      canvas->Fill({wall.x + wall.width * (0.1 + 0.3 * (i % 3)), wall.y + h * (0.06 + 0.15 * (i / 3)),
                    0.05 * w, 0.08 * h},
                   {110, 95, 85});
    }
  }
}

void PaintDrawers(const cv::Scalar& bgr, int num_drawers, Canvas* canvas) {
  const double w = canvas->width(), pitch = canvas->height() / num_drawers;
  PaintWood(bgr, canvas);
  for (int i = 0; i < num_drawers; ++i) {
    canvas->Fill({0, pitch * i, w, 0.006}, bgr * 0.35);
    canvas->Fill({0.35 * w, pitch * (i + 0.18), 0.3 * w, 0.015}, {70, 70, 70});
    if (canvas->rng().Below(2)) canvas->Fill({0.1 * w, pitch * (i + 0.2), 0.08, 0.03}, {235, 235, 235});
  }
}

}  // namespace orbslam
