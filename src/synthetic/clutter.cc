// SPDX-License-Identifier: GPL-3.0-or-later
#include "clutter.h"

#include <array>
#include <cmath>
#include <numbers>

#include "furniture.h"
#include "print.h"
#include "surfaces.h"

namespace orbslam {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// One of a few paints, so that there are few materials.
int Paint(RoomBuilder* room) {
  const uint32_t number = room->rng().Below(7);
  Rng rng(number, 0, 0x7061696E);
  const cv::Scalar bgr = RandomColor(0.35, 0.95, 0.9, &rng) / 255.0;
  return room->Plain("paint" + std::to_string(number), Vector3d(bgr[0], bgr[1], bgr[2]).cast<float>(), 0.2f);
}

Isometry3d At(const Isometry3d& place, double x, double y, double z, double yaw_deg = 0) {
  return place * Place(x, y, z, yaw_deg);
}

/// A leaf that bends down, seen from both sides.
void AddLeaf(const Isometry3d& root, double length, double width, int material, RoomBuilder* room) {
  const auto point = [&](double t) { return Vector3d(length * t, 0, length * (0.9 * t - 0.8 * t * t)); };
  constexpr std::array kWidths{0.25, 1.0, 0.8, 0.1};
  MeshBuilder& leaves = room->Shape(material);
  for (size_t i = 0; i + 1 < kWidths.size(); ++i) {
    const Vector3d from = point(static_cast<double>(i) / 3),
                   along = point(static_cast<double>(i + 1) / 3) - from;
    const Vector3d side(0, 0.5 * width * (kWidths[i] + kWidths[i + 1]) / 2, 0);
    const Eigen::Matrix3d turn = root.linear();
    leaves.AddQuad(root * (from + side), turn * along, turn * (-2 * side), {});
    leaves.AddQuad(root * (from - side), turn * along, turn * (2 * side), {});
  }
}

}  // namespace

void AddMug(const Isometry3d& place, RoomBuilder* room) {
  const std::array outside{Vector2d(0.0, 0.001), Vector2d(0.036, 0.002), Vector2d(0.04, 0.01),
                           Vector2d(0.04, 0.095)};
  const std::array inside{Vector2d(0.04, 0.095), Vector2d(0.036, 0.095), Vector2d(0.035, 0.02),
                          Vector2d(0.0, 0.02)};
  MeshBuilder& mug = room->Shape(Paint(room));
  mug.AddLathe(place, outside, 20);
  mug.AddLathe(place, inside, 20);
  std::array<Vector3d, 7> handle;
  for (size_t i = 0; i < handle.size(); ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / 6 - 0.5);
    handle[i] = place * Vector3d(0.038 + 0.028 * std::cos(angle), 0, 0.05 + 0.03 * std::sin(angle));
  }
  mug.AddTube(handle, 0.006, 8);
  room->Occlude(place, {-0.03, -0.03, 0}, {0.03, 0.03, 0.09});
}

void AddBottle(const Isometry3d& place, RoomBuilder* room) {
  const std::array body{Vector2d(0.0, 0.0), Vector2d(0.032, 0.003), Vector2d(0.033, 0.15),
                        Vector2d(0.013, 0.2), Vector2d(0.013, 0.22)};
  const std::array lid{Vector2d(0.015, 0.22), Vector2d(0.015, 0.24), Vector2d(0.0, 0.241)};
  room->Shape(Paint(room)).AddLathe(place, body, 16);
  room->Shape(WhitePlastic(room)).AddLathe(place, lid, 12);
  room->Occlude(place, {-0.025, -0.025, 0}, {0.025, 0.025, 0.2});
}

void AddPaper(const Isometry3d& place, RoomBuilder* room) {
  const double thickness = room->rng().Uniform(0.001, 0.004);
  room->Picture(place, {-0.105, -0.148, 0}, {0.105, 0.148, thickness}, Face::kTop, 2.2, {},
                [](Canvas* c) { PaintPage(c->Whole(), c); });
}

void AddBookStack(const Isometry3d& place, int num_books, RoomBuilder* room) {
  double z = 0;
  for (int i = 0; i < num_books; ++i) {
    const double thickness = room->rng().Uniform(0.012, 0.045), yaw = room->rng().Uniform(-14, 14);
    const double width = room->rng().Uniform(0.15, 0.21), depth = room->rng().Uniform(0.2, 0.28);
    const Isometry3d at = At(place, 0, 0, z, yaw);
    const Vector3d low(-0.5 * width, -0.5 * depth, 0), high(0.5 * width, 0.5 * depth, thickness);
    room->Box(at, low, high, Paint(room));
    if (i + 1 == num_books) {
      room->Picture(at, low, high + Vector3d(0, 0, 0.0012), Face::kTop, 2, {.shininess = 0.1f},
                    [](Canvas* c) { PaintPoster(c->Whole(), c); });
    }
    z += thickness;
  }
}

void AddKeyboardAndMouse(const Isometry3d& place, RoomBuilder* room) {
  room->Box(place, {-0.22, -0.07, 0}, {0.22, 0.07, 0.018}, BlackPlastic(room));
  room->Picture(place, {-0.22, -0.07, 0}, {0.22, 0.07, 0.0195}, Face::kTop, 3, {.infrared = 0.5f},
                PaintKeyboard);
  const std::array mouse{Vector2d(0.0, 0.0), Vector2d(0.033, 0.004), Vector2d(0.03, 0.02),
                         Vector2d(0.015, 0.032), Vector2d(0.0, 0.034)};
  const Isometry3d beside = At(place, 0.31, 0.0, 0, room->rng().Uniform(-20, 20));
  room->Shape(BlackPlastic(room)).AddLathe(beside, mouse, 14);
}

void AddCarton(const Isometry3d& place, const Vector3d& size, RoomBuilder* room) {
  const Vector3d low(-0.5 * size.x(), -0.5 * size.y(), 0), high(0.5 * size.x(), 0.5 * size.y(), size.z());
  for (const Face face : {Face::kFront, Face::kLeft, Face::kRight, Face::kTop, Face::kBack}) {
    room->Picture(place, low, high, face, 1.4, {}, PaintCarton);
  }
  room->Occlude(place, low, high);
}

void AddPlant(const Isometry3d& place, double height, RoomBuilder* room) {
  const double pot = 0.3 * height;
  const std::array profile{Vector2d(0.0, 0.0), Vector2d(0.3 * pot, 0.0), Vector2d(0.45 * pot, 0.95 * pot),
                           Vector2d(0.45 * pot, pot), Vector2d(0.0, 0.9 * pot)};
  room->Shape(Paint(room)).AddLathe(place, profile, 18);
  room->Occlude(place, {-0.35 * pot, -0.35 * pot, 0}, {0.35 * pot, 0.35 * pot, 0.95 * pot});
  for (int i = 0; i < 26; ++i) {
    const int green = room->Tiled(
        i % 2 ? "leaf" : "other leaf", 0.2, 1.2, {.shininess = 0.1f},
        [&](Canvas* c) { PaintFabric(FromHsv(i % 2 ? 0.3 : 0.26, 0.6, i % 2 ? 0.42 : 0.58), c); });
    const double up = pot + (height - pot) * room->rng().Uniform(0.0, 0.6),
                 tilt = room->rng().Uniform(-0.9, 0.1);
    Isometry3d root = At(place, 0, 0, up, 137.5 * i);
    root.rotate(Eigen::AngleAxisd(tilt, Vector3d::UnitY()));
    AddLeaf(root, height * room->rng().Uniform(0.25, 0.45), 0.12 * height, green, room);
  }
  const std::array stem{Vector3d(place * Vector3d(0, 0, 0.9 * pot)),
                        Vector3d(place * Vector3d(0, 0, 0.85 * height))};
  room->Shape(LightWood(room)).AddTube(stem, 0.01, 6);
}

void AddDeskLamp(const Isometry3d& place, RoomBuilder* room) {
  const int paint = Paint(room);
  const std::array base{Vector2d(0.08, 0.0), Vector2d(0.08, 0.015), Vector2d(0.0, 0.02)};
  room->Shape(paint).AddLathe(place, base, 20);
  const std::array arm{Vector3d(place * Vector3d(0, 0, 0.01)), Vector3d(place * Vector3d(-0.1, 0, 0.28)),
                       Vector3d(place * Vector3d(0.12, -0.03, 0.46))};
  room->Shape(Metal(room)).AddTube(arm, 0.008, 8);
  Isometry3d head = At(place, 0.15, -0.04, 0.4);
  head.rotate(Eigen::AngleAxisd(-0.4, Vector3d::UnitY()));
  const std::array cone{Vector2d(0.075, 0.0), Vector2d(0.03, 0.09), Vector2d(0.0, 0.11)};
  room->Shape(paint).AddLathe(head, cone, 20);
}

void AddPenHolder(const Isometry3d& place, RoomBuilder* room) {
  const std::array cup{Vector2d(0.0, 0.0), Vector2d(0.04, 0.0), Vector2d(0.04, 0.1), Vector2d(0.036, 0.1),
                       Vector2d(0.036, 0.01)};
  room->Shape(Metal(room)).AddLathe(place, cup, 14);
  for (int i = 0; i < 6; ++i) {
    const double angle = room->rng().Uniform(0, 6.28), lean = room->rng().Uniform(0.01, 0.035);
    const Vector3d tip(2 * lean * std::cos(angle), 2 * lean * std::sin(angle),
                       room->rng().Uniform(0.13, 0.17));
    const std::array pen{Vector3d(place * Vector3d(0, 0, 0.01)), Vector3d(place * tip)};
    room->Shape(Paint(room)).AddTube(pen, 0.004, 6);
  }
}

void AddBin(const Isometry3d& place, RoomBuilder* room) {
  const std::array wall{Vector2d(0.1, 0.0), Vector2d(0.13, 0.3)};
  const std::array inside{Vector2d(0.128, 0.3), Vector2d(0.1, 0.02), Vector2d(0.0, 0.02)};
  MeshBuilder& bin = room->Shape(BlackPlastic(room));
  bin.AddLathe(place, wall, 18);
  bin.AddLathe(place, inside, 18);
  room->Occlude(place, {-0.09, -0.09, 0}, {0.09, 0.09, 0.28});
}

void AddPrinter(const Isometry3d& place, RoomBuilder* room) {
  room->Box(place, {-0.22, -0.2, 0}, {0.22, 0.18, 0.2}, WhitePlastic(room));
  room->Box(place, {-0.2, -0.17, 0.2}, {0.2, 0.16, 0.26}, BlackPlastic(room));
  room->Picture(place, {-0.22, -0.202, 0.0}, {0.22, 0, 0.2}, Face::kFront, 2, {}, [](Canvas* c) {
    c->Fill(c->Whole(), {205, 208, 210});
    c->Fill({0.04, 0.1, 0.36, 0.03}, {50, 50, 50});
    c->Fill({0.3, 0.02, 0.1, 0.05}, {120, 160, 60});
    c->Text("laser 4", {0.03, 0.06}, 0.025, {70, 70, 70});
  });
  AddPaper(At(place, 0, 0, 0.262, 8), room);
}

void AddCable(const Vector3d& from, const Vector3d& to, double droop, RoomBuilder* room) {
  constexpr int kPieces = 10;
  std::vector<Vector3d> path;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = static_cast<double>(i) / kPieces;
    path.push_back(from + t * (to - from) - 4 * t * (1 - t) * droop * Vector3d::UnitZ());
  }
  room->Shape(BlackPlastic(room)).AddTube(path, 0.005, 6);
}

void ClutterDesk(const Isometry3d& desk, double width, double depth, int density, RoomBuilder* room) {
  const double top = kDeskHeightM + 0.0005;
  for (int i = 0; i < 2 * density; ++i) {
    const double x = room->rng().Uniform(-0.5, 0.5) * (width - 0.3),
                 y = -depth + 0.18 + room->rng().Uniform() * (depth - 0.36);
    AddPaper(At(desk, x, y, top + 0.0008 * i, room->rng().Uniform(-40, 40)), room);
  }
  for (int i = 0; i < density; ++i) {
    const double slot = -0.5 * width + 0.12 + (width - 0.24) * (i + room->rng().Uniform(0.1, 0.9)) / density;
    const Isometry3d at = At(desk, slot, -depth + room->rng().Uniform(0.12, 0.45 * depth), top + 0.006,
                             room->rng().Uniform(-50, 50));
    switch (room->rng().Below(5)) {
      case 0:
        AddMug(at, room);
        break;
      case 1:
        AddBottle(at, room);
        break;
      case 2:
        AddPenHolder(at, room);
        break;
      case 3:
        AddBookStack(at, 1 + static_cast<int>(room->rng().Below(4)), room);
        break;
      default:
        AddMug(at, room);
        AddPaper(At(at, 0.1, 0.05, 0.0, 20), room);
    }
  }
}

}  // namespace orbslam
