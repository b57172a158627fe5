// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "canvas.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

cv::Rect2d Whole(const Canvas& canvas) { return {0, 0, canvas.width_m(), canvas.height_m()}; }

cv::Scalar Vary(const cv::Scalar& bgr, double amount, Rng* rng) {
  return bgr * rng->Uniform(1 - amount, 1 + amount);
}

/// Courses of bricks, tiles or boards; every second course is shifted by half a unit.
void PaintCourses(cv::Size2d unit_m, double joint_m, const cv::Scalar& bgr, double variation,
                  Canvas* canvas) {
  canvas->Fill(Whole(*canvas), bgr * 0.6);
  int course = 0;
  for (double y = 0; y < canvas->height_m(); y += unit_m.height, ++course) {
    for (double x = course % 2 ? -0.5 * unit_m.width : 0.0; x < canvas->width_m(); x += unit_m.width) {
      canvas->Fill({x, y, unit_m.width - joint_m, unit_m.height - joint_m},
                   Vary(bgr, variation, &canvas->rng()));
    }
  }
}

/// Posters side by side on a wall, hung at eye level, with gaps of bare wall.
void HangPosters(Canvas* canvas) {
  Rng& rng = canvas->rng();
  for (double x = rng.Uniform(0.1, 0.3); x < canvas->width_m() - 0.5;) {
    const double width = rng.Uniform(0.3, 0.8), height = rng.Uniform(0.35, 0.75);
    const double top = rng.Uniform(0.45, 0.85), gap = rng.Uniform(0.08, 0.4);
    if (x + width < canvas->width_m() - 0.05) canvas->Poster({x, top, width, height});
    if (rng.Below(2)) canvas->Poster({x, top + height + 0.06, 0.21, 0.297});
    x += width + gap;
  }
}

void PaintPlasterWall(Canvas* canvas) {
  canvas->Fill(Whole(*canvas), {170, 190, 195, 255});
  canvas->Roughen(14);
  HangPosters(canvas);
}

void PaintBrickWall(Canvas* canvas) {
  PaintCourses({0.25, 0.08}, 0.012, {85, 105, 165, 255}, 0.3, canvas);
  canvas->Roughen(25);
  HangPosters(canvas);
}

void PaintBoards(cv::Size2d board_m, double joint_m, double variation, Canvas* canvas) {
  PaintCourses(board_m, joint_m, {88, 125, 158, 255}, variation, canvas);
  canvas->Roughen(22);
}

void PaintBooks(Canvas* canvas) {
  constexpr double kBoardM = 0.03, kShelfM = 0.34;
  Rng& rng = canvas->rng();
  canvas->Fill(Whole(*canvas), {30, 40, 50, 255});
  for (double top = 0; top < canvas->height_m(); top += kShelfM) {
    const double bottom = top + kShelfM;
    for (double x = kBoardM; x < canvas->width_m() - kBoardM;) {
      const double width = rng.Uniform(0.02, 0.07), height = rng.Uniform(0.18, 0.29);
      const double right = std::min(x + width, canvas->width_m() - kBoardM);
      const double lightness = rng.Uniform(40, 210);
      const cv::Rect2d label(x + 0.2 * width, bottom - 0.8 * height, 0.5 * width,
                             rng.Uniform(0.1, 0.5) * height);
      canvas->Fill({x, bottom - height, right - x - 0.004, height}, RandomColor(lightness, &rng));
      canvas->Fill(label, RandomColor(lightness > 120 ? 50 : 220, &rng));
      x += width + (rng.Below(12) == 0 ? rng.Uniform(0.05, 0.2) : 0.0);
    }
    canvas->Fill({0, top, canvas->width_m(), kBoardM}, {120, 160, 190, 255});
  }
  canvas->Fill({0, 0, kBoardM, canvas->height_m()}, {120, 160, 190, 255});
  canvas->Fill({canvas->width_m() - kBoardM, 0, kBoardM, canvas->height_m()}, {120, 160, 190, 255});
  canvas->Roughen(12);
}

void PaintDesktop(Canvas* canvas) {
  Rng& rng = canvas->rng();
  PaintCourses({0.9, 0.09}, 0.003, {105, 150, 185, 255}, 0.1, canvas);
  const auto sheets = static_cast<int>(canvas->width_m() * canvas->height_m() * 9);
  for (int i = 0; i < sheets; ++i) {
    const double left = rng.Uniform(0, canvas->width_m() - 0.2),
                 top = rng.Uniform(0, canvas->height_m() - 0.2);
    const cv::Rect2d sheet(left, top, 0.21, 0.297);
    canvas->Fill(sheet, Vary({225, 230, 230, 255}, 0.08, &rng));
    canvas->Write({sheet.x + 0.02, sheet.y + 0.02, 0.17, 0.25}, rng.Uniform(0.012, 0.03), {60, 50, 50, 255});
  }
  canvas->Roughen(8);
}

void PaintScreen(Canvas* canvas) {
  const double w = canvas->width_m(), h = canvas->height_m();
  canvas->Fill(Whole(*canvas), {35, 35, 35, 255});
  canvas->Fill({0.02, 0.02, w - 0.04, h - 0.04}, {90, 60, 45, 255});
  for (int pane = 0; pane < 2; ++pane) {
    const cv::Rect2d area(0.03 + pane * 0.5 * (w - 0.04), 0.05, 0.44 * w, h - 0.1);
    canvas->Fill(area, {50, 35, 30, 255});
    canvas->Write(area, 0.014 + 0.01 * pane, RandomColor(190, &canvas->rng()));
  }
}

void PaintCarton(Canvas* canvas) {
  const double w = canvas->width_m(), h = canvas->height_m();
  canvas->Fill(Whole(*canvas), Vary({95, 140, 175, 255}, 0.15, &canvas->rng()));
  canvas->Fill({0, 0.45 * h, w, 0.05}, {140, 185, 205, 255});
  canvas->Poster({0.1 * w, 0.55 * h, 0.4 * w, 0.38 * h});
  canvas->Write({0.08 * w, 0.08 * h, 0.85 * w, 0.34 * h}, 0.15 * h, {40, 45, 60, 255});
  canvas->Roughen(12);
}

/// Cupboard doors: few corners, on purpose; every second one has a notice.
void PaintDoors(Canvas* canvas) {
  const double w = canvas->width_m(), h = canvas->height_m();
  const int doors = std::max(1, static_cast<int>(w / 0.45));
  canvas->Fill(Whole(*canvas), {70, 80, 85, 255});
  for (int i = 0; i < doors; ++i) {
    const double left = i * w / doors, width = w / doors;
    canvas->Fill({left + 0.008, 0.008, width - 0.016, h - 0.016}, {185, 195, 200, 255});
    canvas->Fill({left + (i % 2 ? 0.05 : width - 0.07), 0.4 * h, 0.02, 0.14}, {60, 60, 60, 255});
    if (i % 2) canvas->Poster({left + 0.5 * width - 0.1, 0.12 * h, 0.21, 0.2 * h});
  }
  canvas->Roughen(6);
}

void PaintCeiling(Canvas* canvas) {
  PaintCourses({0.6, 0.6}, 0.012, {205, 210, 210, 255}, 0.04, canvas);
  for (double x = 0.9; x < canvas->width_m() - 1; x += 1.8) {
    canvas->Fill({x, 1.2, 0.6, 1.2}, {255, 255, 255, 255});
  }
  canvas->Roughen(8);
}

}  // namespace

void Paint(Material material, Canvas* canvas) {
  switch (material) {
    case Material::kPlaster:
      return PaintPlasterWall(canvas);
    case Material::kBrick:
      return PaintBrickWall(canvas);
    case Material::kFloorboards:
      return PaintBoards({0.5, 0.125}, 0.006, 0.22, canvas);
    case Material::kCeiling:
      return PaintCeiling(canvas);
    case Material::kWood:
      return PaintBoards({1.2, 0.11}, 0.003, 0.08, canvas);
    case Material::kDesktop:
      return PaintDesktop(canvas);
    case Material::kBooks:
      return PaintBooks(canvas);
    case Material::kScreen:
      return PaintScreen(canvas);
    case Material::kCarton:
      return PaintCarton(canvas);
    case Material::kDoors:
      return PaintDoors(canvas);
  }
  ORBSLAM_CHECK(false);
}

}  // namespace orbslam
