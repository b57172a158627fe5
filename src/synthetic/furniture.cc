// SPDX-License-Identifier: GPL-3.0-or-later
#include "furniture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "print.h"
#include "surfaces.h"

namespace orbslam {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const Material kPaper{};
const cv::Scalar kBeech(140, 185, 215);

Isometry3d Moved(const Isometry3d& place, double x, double y, double z) {
  return place * Eigen::Translation3d(x, y, z);
}

}  // namespace

int LightWood(RoomBuilder* room) {
  return room->Tiled("beech", 1.2, 1, {.shininess = 0.04f}, [](Canvas* c) { PaintWood(kBeech, c); });
}
int Metal(RoomBuilder* room) { return room->Plain("metal", {0.62f, 0.62f, 0.62f}, 0.25f, 0.7f); }
int BlackPlastic(RoomBuilder* room) { return room->Plain("black", {0.17f, 0.17f, 0.17f}, 0.12f, 0.12f); }
int WhitePlastic(RoomBuilder* room) { return room->Plain("white", {0.82f, 0.86f, 0.87f}, 0.08f); }

void AddDesk(const Isometry3d& place, double width, double depth, RoomBuilder* room) {
  const double w = 0.5 * width, top = kDeskHeightM;
  room->Box(place, {-w, -depth, top - 0.03}, {w, 0, top - 0.001}, LightWood(room));
  room->Picture(place, {-w, -depth, top - 0.01}, {w, 0, top}, Face::kTop, 1.6, {.shininess = 0.05f},
                [](Canvas* c) {
                  PaintWood(kBeech, c);
                  for (int i = 0; i < 5; ++i) {  // rings of cups, scratches
                    const cv::Point2d at{c->rng().Uniform(0.1, c->width() - 0.1),
                                         c->rng().Uniform(0.1, c->height() - 0.1)};
                    c->Ring(at, 0.04, 0.003, kBeech * 0.8);
                    c->Line(at, at + cv::Point2d(0.07, 0.03), 0.002, kBeech * 0.75);
                  }
                });
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (w - 0.06);
    room->Box(place, {x - 0.025, -depth + 0.08, 0.03}, {x + 0.025, -depth + 0.13, top - 0.03}, Metal(room));
    room->Box(place, {x - 0.025, -0.13, 0.03}, {x + 0.025, -0.08, top - 0.03}, Metal(room));
    room->Box(place, {x - 0.03, -depth + 0.04, 0}, {x + 0.03, -0.04, 0.03}, Metal(room));
  }
  room->Box(place, {-w + 0.1, -0.06, 0.35}, {w - 0.1, -0.04, top - 0.03}, LightWood(room));
  const Isometry3d drawers = Moved(place, w - 0.36, 0, 0);
  room->Box(drawers, {-0.2, -depth + 0.1, 0.06}, {0.2, -0.1, 0.6}, WhitePlastic(room));
  room->Picture(drawers, {-0.2, -depth + 0.098, 0.06}, {0.2, 0, 0.6}, Face::kFront, 1, {}, [](Canvas* c) {
    PaintDrawers({205, 210, 210}, 4, c);
  });
}

void AddBookRow(const Isometry3d& place, double width, double height, double depth, RoomBuilder* room) {
  for (double x = -0.5 * width; x < 0.5 * width - 0.08;) {
    const double piece = std::min(room->rng().Uniform(0.15, 0.4), 0.5 * width - x);
    const double front = -depth + room->rng().Uniform(0.0, 0.05),
                 top = height * room->rng().Uniform(0.8, 1.0);
    const Isometry3d at = Moved(place, x, 0, 0);
    const int pages = room->Plain("pages", {0.75f, 0.82f, 0.85f});
    room->Box(at, {0.001, front + 0.001, 0}, {piece - 0.001, 0, 0.8 * top}, pages);
    room->Picture(at, {0, front, 0}, {piece, 0, top}, Face::kFront, 2, kPaper, PaintBookBacks);
    x += piece + (room->rng().Below(4) == 0 ? 0.06 : 0.0);
  }
}

void AddBookcase(const Isometry3d& place, double width, double height, RoomBuilder* room) {
  constexpr double kDepth = 0.32, kBoard = 0.025;
  const double w = 0.5 * width;
  const int wood = LightWood(room), levels = std::max(1, static_cast<int>(height / 0.36));
  room->Box(place, {-w, -kDepth, 0}, {-w + kBoard, 0, height}, wood);
  room->Box(place, {w - kBoard, -kDepth, 0}, {w, 0, height}, wood);
  room->Box(place, {-w, -0.012, 0}, {w, 0, height}, wood);
  const double pitch = (height - kBoard) / levels;
  for (int level = 0; level <= levels; ++level) {
    const double z = pitch * level;
    room->Box(place, {-w + kBoard, -kDepth + 0.005, z}, {w - kBoard, -0.012, z + kBoard}, wood);
    if (level < levels)
      AddBookRow(Moved(place, 0, -0.02, z + kBoard), width - 2 * kBoard, pitch - 0.06, kDepth - 0.07, room);
  }
}

void AddCabinet(const Isometry3d& place, double width, double depth, double height, RoomBuilder* room) {
  const double w = 0.5 * width;
  room->Box(place, {-w, -depth, 0}, {w, 0, height}, LightWood(room));
  const int doors = std::max(1, static_cast<int>(width / 0.45));
  room->Picture(
      place, {-w, -depth - 0.003, 0.05}, {w, 0, height - 0.02}, Face::kFront, 1, {}, [&](Canvas* c) {
        const double pitch = c->width() / doors;
        PaintWood({150, 170, 180}, c);
        for (int i = 0; i < doors; ++i) {
          c->Fill({pitch * i, 0, 0.006, c->height()}, {60, 70, 75});
          c->Fill({pitch * i + (i % 2 ? 0.05 : pitch - 0.07), 0.3 * c->height(), 0.02, 0.13}, {90, 90, 90});
          if (c->rng().Below(2)) PaintPage({pitch * i + 0.1, 0.12, 0.21, 0.297}, c);
        }
      });
}

void AddChair(const Isometry3d& place, RoomBuilder* room) {
  const int fabric = room->Tiled("fabric", 0.4, 1.5, {},
                                 [](Canvas* c) { PaintFabric(RandomColor(0.25, 0.5, 0.7, &c->rng()), c); });
  room->Box(place, {-0.23, -0.23, 0.43}, {0.23, 0.23, 0.49}, fabric);
  room->Box(place, {-0.21, 0.2, 0.58}, {0.21, 0.25, 0.98}, fabric);
  room->Box(place, {-0.04, 0.23, 0.42}, {0.04, 0.26, 0.62}, BlackPlastic(room));
  for (const double side : {-1.0, 1.0}) {
    room->Box(place, {side * 0.27 - 0.025, -0.12, 0.64}, {side * 0.27 + 0.025, 0.14, 0.67},
              BlackPlastic(room));
    room->Box(place, {side * 0.27 - 0.015, -0.02, 0.45}, {side * 0.27 + 0.015, 0.03, 0.64},
              BlackPlastic(room));
  }
  MeshBuilder& metal = room->Shape(Metal(room));
  const std::array column{Vector2d(0.025, 0.08), Vector2d(0.025, 0.43)};
  metal.AddLathe(place, column, 12);
  for (int leg = 0; leg < 5; ++leg) {
    const double angle = 2 * std::numbers::pi * leg / 5 + 0.3;
    const Vector3d out(0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.06);
    const std::array bar{Vector3d(place * Vector3d(0, 0, 0.1)), Vector3d(place * out)};
    metal.AddTube(bar, 0.02, 8);
    const std::array wheel{Vector2d(0.0, 0.0), Vector2d(0.03, 0.01), Vector2d(0.03, 0.05),
                           Vector2d(0.0, 0.06)};
    room->Shape(BlackPlastic(room)).AddLathe(Moved(place, out.x(), out.y(), 0), wheel, 8);
  }
}

void AddMonitor(const Isometry3d& place, double width, bool is_on, RoomBuilder* room) {
  const double w = 0.5 * width, height = 0.6 * width, low = 0.12;
  const int black = BlackPlastic(room);
  room->Box(place, {-0.12, -0.09, 0}, {0.12, 0.09, 0.012}, black);
  room->Box(place, {-0.025, 0.01, 0.012}, {0.025, 0.04, low + 0.2}, black);
  room->Box(place, {-w, -0.025, low}, {w, 0.01, low + height}, black);
  Material look{.shininess = 0.1f, .emission = 0.8f, .infrared = 0.03f};
  if (!is_on) look.color_bgr = {0.12f, 0.11f, 0.11f}, look.emission = 0, look.shininess = 0.3f;
  room->Picture(place, {-w + 0.015, -0.026, low + 0.02}, {w - 0.015, 0, low + height - 0.015}, Face::kFront,
                2.5, look, PaintScreen);
}

void AddPoster(const Isometry3d& place, double width, double height, RoomBuilder* room) {
  const double w = 0.5 * width, h = 0.5 * height;
  room->Picture(place, {-w, -0.004, -h}, {w, 0, h}, Face::kFront, 1.8, kPaper,
                [](Canvas* c) { PaintPoster(c->Whole(), c); });
}

void AddWhiteboard(const Isometry3d& place, double width, double height, RoomBuilder* room) {
  const double w = 0.5 * width, h = 0.5 * height;
  room->Box(place, {-w, -0.02, -h}, {w, 0, h}, Metal(room));
  room->Box(place, {-0.7 * w, -0.07, -h - 0.02}, {0.7 * w, 0, -h}, Metal(room));
  room->Picture(place, {-w + 0.005, -0.021, -h + 0.005}, {w - 0.005, 0, h - 0.005}, Face::kFront, 1.3,
                {.shininess = 0.15f, .infrared = 0.8f}, PaintWhiteboard);
}

void AddWindow(const Isometry3d& place, double width, double height, RoomBuilder* room) {
  const double w = 0.5 * width, h = 0.5 * height;
  const int frame = WhitePlastic(room);
  room->Picture(place, {-w, -0.003, -h}, {w, 0, h}, Face::kFront, 0.9, {.emission = 1, .infrared = 0},
                PaintOutdoors);
  for (const double x : {-w, 0.0, w}) room->Box(place, {x - 0.04, -0.05, -h}, {x + 0.04, 0, h}, frame);
  for (const double z : {-h, h})
    room->Box(place, {-w - 0.04, -0.05, z - 0.04}, {w + 0.04, 0, z + 0.04}, frame);
  room->Box(place, {-w - 0.08, -0.2, -h - 0.06}, {w + 0.08, 0, -h - 0.03}, frame);
}

void AddRadiator(const Isometry3d& place, double width, RoomBuilder* room) {
  const int white = WhitePlastic(room);
  room->Box(place, {-0.5 * width, -0.07, 0.12}, {0.5 * width, -0.03, 0.62}, white);
  for (double x = -0.5 * width + 0.03; x < 0.5 * width; x += 0.06) {
    room->Box(place, {x - 0.018, -0.1, 0.14}, {x + 0.018, -0.07, 0.6}, white);
  }
}

}  // namespace orbslam
