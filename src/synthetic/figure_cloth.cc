// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace orbslam {
namespace {

constexpr int kTilePx = 256;

uint8_t Byte(double value) { return static_cast<uint8_t>(std::clamp(value, 0.0, 255.0)); }

cv::Vec3d Dye(double lightness, double spread, Rng* rng) {
  cv::Vec3d dye;
  for (double& channel : dye.val) channel = lightness + spread * rng->Uniform(-1, 1);
  return dye;
}

/// Smooth noise in [-1, 1] that repeats, CV_64FC1, with `cells` bumps across the tile.
cv::Mat_<double> TileNoise(int cells, Rng* rng) {
  constexpr int kRing = 2;
  cv::Mat_<double> coarse(cells, cells), padded, field;
  for (double& value : coarse) value = rng->Uniform(-1, 1);
  cv::copyMakeBorder(coarse, padded, kRing, kRing, kRing, kRing, cv::BORDER_WRAP);
  const int scale = kTilePx / cells;
  cv::resize(padded, field, {}, scale, scale, cv::INTER_CUBIC);
  return field(cv::Rect(kRing * scale, kRing * scale, kTilePx, kTilePx)).clone();
}

/// Multiplies by 1 + threads and wear.
void Wear(double threads, double wear, Rng* rng, cv::Mat_<cv::Vec3d>* tile) {
  const cv::Mat_<double> coarse = TileNoise(8, rng), middle = TileNoise(32, rng), fine = TileNoise(256, rng);
  for (int y = 0; y < kTilePx; ++y) {
    for (int x = 0; x < kTilePx; ++x) {
      (*tile)(y, x) *= 1 + wear * (0.6 * coarse(y, x) + 0.6 * middle(y, x)) + threads * fine(y, x);
    }
  }
}

cv::Mat_<cv::Vec3d> Checks(Rng* rng) {
  // Warp and weft have the same bands; where they cross the colours mix.
  const std::array<cv::Vec3d, 3> dyes = {Dye(45, 40, rng), Dye(215, 35, rng), Dye(120, 110, rng)};
  constexpr int kBand = 8;
  std::array<int, kTilePx / kBand> bands{};
  for (size_t i = 0; i < bands.size(); ++i) bands[i] = static_cast<int>(i / 4 % 2);
  for (size_t i = 0; i < bands.size(); i += 8) bands[i + 1 + rng->Below(2)] = 2;
  cv::Mat_<cv::Vec3d> tile(kTilePx, kTilePx);
  for (int y = 0; y < kTilePx; ++y) {
    for (int x = 0; x < kTilePx; ++x) {
      tile(y, x) = 0.5 * dyes[bands[x / kBand]] + 0.5 * dyes[bands[y / kBand]];
    }
  }
  return tile;
}

cv::Mat_<cv::Vec3d> Stripes(Rng* rng) {
  const std::array<cv::Vec3d, 3> dyes = {Dye(40, 30, rng), Dye(225, 25, rng), Dye(130, 110, rng)};
  cv::Mat_<cv::Vec3d> tile(kTilePx, kTilePx);
  for (int y = 0; y < kTilePx; ++y) {
    // Bands of 2 cm; small figures woven into every other one.
    const int band = y / 16, row = y % 16 / 4;
    for (int x = 0; x < kTilePx; ++x) {
      const bool woven = band % 4 == 2 && row > 0 && row < 3 && x / 8 % 3 == row % 3;
      tile(y, x) = dyes[woven ? 0 : (band % 2 == 0 ? 1 : (band % 4 == 1 ? 0 : 2))];
    }
  }
  return tile;
}

cv::Mat_<cv::Vec3d> Print(Rng* rng) {
  cv::Mat picture(kTilePx, kTilePx, CV_64FC3, cv::Scalar(Dye(200, 40, rng)));
  for (int i = 0; i < 170; ++i) {
    const cv::Point center(static_cast<int>(rng->Below(kTilePx)), static_cast<int>(rng->Below(kTilePx)));
    const cv::Size axes(static_cast<int>(3 + rng->Below(16)), static_cast<int>(2 + rng->Below(8)));
    const double angle = rng->Uniform(0, 180);
    const cv::Scalar dye(Dye(i % 3 == 0 ? 210 : 70, 60, rng));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        cv::ellipse(picture, center + kTilePx * cv::Point(dx, dy), axes, angle, 0, 360, dye, cv::FILLED);
      }
    }
  }
  return picture;
}

cv::Mat_<cv::Vec3d> Knit(Rng* rng) {
  const std::array<cv::Vec3d, 2> dyes = {Dye(60, 40, rng), Dye(205, 40, rng)};
  constexpr int kStitch = 8;  // 1 cm
  cv::Mat_<cv::Vec3d> tile(kTilePx, kTilePx);
  for (int y = 0; y < kTilePx; ++y) {
    for (int x = 0; x < kTilePx; ++x) {
      const int column = x / kStitch, row = (y + std::abs(x % kStitch - kStitch / 2)) % kTilePx / kStitch;
      const int diamond = std::abs(column % 8 - 4) + std::abs(row % 8 - 4);
      const bool light = row % 16 < 8 ? diamond < 3 || diamond == 5 : (column + row) % 4 == 0;
      const double loop = 0.72 + 0.28 * std::abs(std::sin(3.1416 * x / (kStitch / 2.0)));
      tile(y, x) = loop * dyes[light ? 1 : 0];
    }
  }
  return tile;
}

cv::Mat_<cv::Vec3d> Jeans(Rng* rng) {
  const cv::Vec3d indigo(rng->Uniform(95, 135), rng->Uniform(65, 90), rng->Uniform(45, 65));
  const cv::Mat_<double> worn = TileNoise(16, rng), specks = TileNoise(64, rng);
  cv::Mat_<cv::Vec3d> tile(kTilePx, kTilePx);
  for (int y = 0; y < kTilePx; ++y) {
    for (int x = 0; x < kTilePx; ++x) {
      const double twill = (x + y) % 4 < 2 ? 1.12 : 0.9;
      const double faded = std::max(0.0, worn(y, x)) * 0.8 + (specks(y, x) > 0.55 ? 0.45 : 0);
      tile(y, x) = twill * (indigo + faded * cv::Vec3d(90, 95, 95));
    }
  }
  return tile;
}

cv::Mat_<cv::Vec3d> Weave(Cloth cloth, Rng* rng) {
  switch (cloth) {
    case Cloth::kChecks:
      return Checks(rng);
    case Cloth::kStripes:
      return Stripes(rng);
    case Cloth::kPrint:
      return Print(rng);
    case Cloth::kKnit:
      return Knit(rng);
    case Cloth::kJeans:
      return Jeans(rng);
  }
  return {};
}

void Letters(const cv::Rect& area, const cv::Scalar& ink, Rng* rng, cv::Mat* picture) {
  std::string word;
  const auto count = 4 + rng->Below(3);
  for (uint32_t i = 0; i < count; ++i) word += static_cast<char>('A' + rng->Below(26));
  const int face = cv::FONT_HERSHEY_DUPLEX, thick = std::max(2, std::min(area.height, area.width / 4) / 9);
  int base = 0;
  const cv::Size unit = cv::getTextSize(word, face, 1.0, thick, &base);
  const double scale = std::min(area.width / (unit.width + 4.0), area.height / (unit.height + 4.0));
  const cv::Size size = cv::getTextSize(word, face, scale, thick, &base);
  const cv::Point corner(area.x + (area.width - size.width) / 2, area.y + (area.height + size.height) / 2);
  cv::putText(*picture, word, corner, face, scale, ink, thick, cv::LINE_AA);
}

/// What makes a shirt of cloth: buttons down the front and a pocket, or letters on chest and back.
void Tailor(Cloth cloth, double pixels_per_m, Rng* rng, cv::Mat* shirt) {
  const auto px = [pixels_per_m](double metres) {
    return static_cast<int>(std::lround(metres * pixels_per_m));
  };
  const int middle = shirt->cols / 2, top = px(0.12);
  const cv::Scalar dark(35, 30, 30), light(235, 235, 235);
  if (cloth == Cloth::kPrint || cloth == Cloth::kKnit) {
    const cv::Rect chest(middle - px(0.15), top, px(0.30), px(0.11));
    cv::rectangle(*shirt, chest, light, cv::FILLED);
    Letters(chest, dark, rng, shirt);
    const cv::Rect back(shirt->cols - px(0.2), top, px(0.18), px(0.2));
    cv::rectangle(*shirt, back, dark, cv::FILLED);
    Letters(back, light, rng, shirt);
    return;
  }
  const int half = px(0.016);
  cv::line(*shirt, {middle - half, 0}, {middle - half, shirt->rows}, dark, 2);
  cv::line(*shirt, {middle + half, 0}, {middle + half, shirt->rows}, dark, 1);
  for (int y = px(0.08); y < shirt->rows; y += px(0.085)) {
    cv::circle(*shirt, {middle, y}, px(0.006), light, cv::FILLED, cv::LINE_AA);
    cv::circle(*shirt, {middle, y}, px(0.006), dark, 1, cv::LINE_AA);
  }
  const cv::Rect pocket(middle + px(0.05), top, px(0.1), px(0.11));
  cv::rectangle(*shirt, pocket, dark, 2);
  cv::rectangle(*shirt, cv::Rect(pocket.tl(), cv::Size(pocket.width, px(0.025))), dark, 2);
  const cv::Rect badge(middle - px(0.13), top + px(0.02), px(0.075), px(0.05));
  cv::rectangle(*shirt, badge, light, cv::FILLED);
  Letters(badge, dark, rng, shirt);
}

}  // namespace

cv::Mat PaintCloth(Cloth cloth, Rng* rng) {
  cv::Mat_<cv::Vec3d> tile = Weave(cloth, rng);
  Wear(0.10, cloth == Cloth::kJeans ? 0.25 : 0.12, rng, &tile);
  cv::Mat picture;
  tile.convertTo(picture, CV_8UC3);
  return picture;
}

Picture PaintShirt(Cloth cloth, double around_m, double height_m, Rng* rng) {
  const cv::Mat tile = PaintCloth(cloth, rng);
  const double pixels_per_m = kTilePx / kClothTileM;
  const int columns = std::max(1, static_cast<int>(std::lround(around_m / kClothTileM)));
  const int rows = static_cast<int>(std::ceil(height_m / kClothTileM));
  cv::Mat shirt = cv::repeat(tile, rows, columns);
  shirt = shirt.rowRange(0, static_cast<int>(std::lround(height_m * pixels_per_m))).clone();
  Tailor(cloth, pixels_per_m, rng, &shirt);
  return std::make_shared<const cv::Mat>(shirt);
}

Picture PaintSkin(const cv::Scalar& skin_bgr, Rng* rng) {
  cv::Mat_<cv::Vec3d> tile(kTilePx, kTilePx, cv::Vec3d(skin_bgr[0], skin_bgr[1], skin_bgr[2]));
  Wear(0.04, 0.06, rng, &tile);
  auto picture = std::make_shared<cv::Mat>();
  tile.convertTo(*picture, CV_8UC3);
  return picture;
}

Picture PaintHair(const cv::Scalar& hair_bgr, Rng* rng) {
  cv::Mat_<cv::Vec3b> picture(kTilePx, kTilePx);
  // Strands run along v: noise that changes fast across and slowly along.
  const cv::Mat_<double> strands = TileNoise(128, rng), locks = TileNoise(16, rng);
  for (int y = 0; y < kTilePx; ++y) {
    for (int x = 0; x < kTilePx; ++x) {
      const double shade = 1 + 0.45 * strands(y / 16 * 2, x) + 0.3 * locks(y / 2, x);
      for (int c = 0; c < 3; ++c) picture(y, x)[c] = Byte(hair_bgr[c] * shade);
    }
  }
  return std::make_shared<const cv::Mat>(picture);
}

}  // namespace orbslam
