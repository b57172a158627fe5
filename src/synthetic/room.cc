// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/room.h"

#include "clutter.h"
#include "furniture.h"
#include "orbslam/util/check.h"
#include "print.h"
#include "surfaces.h"

namespace orbslam {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kLength = 6.0, kWidth = 5.0, kHeight = 2.7;

// Walls by what one faces who looks at them; yaw turns furniture's back to them.
Isometry3d North(double x, double z) { return Place(x, 0.5 * kWidth, z, 0); }
Isometry3d East(double y, double z) { return Place(0.5 * kLength, y, z, -90); }
Isometry3d South(double x, double z) { return Place(x, -0.5 * kWidth, z, 180); }
Isometry3d West(double y, double z) { return Place(-0.5 * kLength, y, z, 90); }

Lighting OfficeLighting() {
  Lighting lighting;
  for (const double x : {-1.5, 1.5}) {
    for (const double y : {-1.2, 1.2}) {
      lighting.lamps.push_back({{x, y, kHeight - 0.03}, -Vector3d::UnitZ(), {0.85f, 0.93f, 0.97f}});
    }
  }
  lighting.lamps.push_back({{0.5 * kLength - 0.05, 0.3, 1.6}, -Vector3d::UnitX(), {0.75f, 0.66f, 0.6f}});
  lighting.from_above_bgr = {0.36f, 0.37f, 0.38f};
  lighting.from_below_bgr = {0.24f, 0.26f, 0.28f};
  return lighting;
}

void AddShell(RoomBuilder* room) {
  const double x = 0.5 * kLength, y = 0.5 * kWidth;
  const Isometry3d world = Isometry3d::Identity();
  const bool has_carpet = room->rng().Below(2) == 0;
  const double hue = room->rng().Uniform();
  room->Picture(world, {-x, -y, -1}, {x, y, 0}, Face::kTop, 1, {}, [&](Canvas* c) {
    if (has_carpet)
      PaintCarpet(FromHsv(hue, 0.2, 0.45), c);
    else
      PaintParquet(FromHsv(0.08, 0.45, 0.62), c);
  });
  room->Picture(world, {-x, -y, kHeight}, {x, y, kHeight + 1}, Face::kBottom, 0.5, {}, PaintCeiling);
  const cv::Scalar paint = FromHsv(room->rng().Uniform(0.05, 0.2), room->rng().Uniform(0.02, 0.12), 0.9);
  const auto add_wall = [&](const Isometry3d& wall, double length) {
    room->Picture(wall, {-0.5 * length, 0, 0}, {0.5 * length, 1, kHeight}, Face::kFront, 0.75, {},
                  [&](Canvas* c) { PaintPlaster(paint, c); });
    room->Box(wall, {-0.5 * length, -0.015, 0}, {0.5 * length, 0, 0.08}, LightWood(room));
  };
  add_wall(North(0, 0), kLength), add_wall(South(0, 0), kLength);
  add_wall(East(0, 0), kWidth), add_wall(West(0, 0), kWidth);
  const int lamp = room->Tiled("lamp", 0.6, 0.2, {.emission = 1}, [](Canvas*) {});
  for (const double lamp_x : {-1.5, 1.5}) {
    for (const double lamp_y : {-1.2, 1.2}) {
      // Not an occluder: it hangs where its own light comes from.
      room->Shape(lamp).AddQuad({lamp_x - 0.6, lamp_y - 0.15, kHeight - 0.01}, {1.2, 0, 0}, {0, 0.3, 0}, {});
    }
  }
}

/// Two desks with screens, a shelf and posters over them: what the camera looks at most.
void AddNorthSide(RoomBuilder* room) {
  constexpr double kDeskWidth = 1.6, kDepth = 0.75, kTop = kDeskHeightM;
  for (const double x : {-0.82, 0.82}) {
    const Isometry3d desk = North(x, 0) * Place(0, -0.04, 0, 0);
    AddDesk(desk, kDeskWidth, kDepth, room);
    ClutterDesk(desk, kDeskWidth, kDepth, 6, room);
    AddKeyboardAndMouse(
        desk * Place(room->rng().Uniform(-0.1, 0.1), -0.5, kTop + 0.012, room->rng().Uniform(-6, 6)), room);
    AddMonitor(desk * Place(-0.32, -0.24, kTop, 8), 0.55, true, room);
    AddMonitor(desk * Place(0.28, -0.22, kTop, -10), 0.52, room->rng().Below(2) == 0, room);
    AddChair(Place(x + room->rng().Uniform(-0.25, 0.25), 1.62, 0, 180 + room->rng().Uniform(-35, 35)), room);
    AddCable(desk * Vector3d(-0.3, -0.15, kTop), desk * Vector3d(0.1, -0.07, 0.2), 0.1, room);
  }
  AddDeskLamp(North(0.02, kTop) * Place(0, -0.25, 0, 0), room);
  AddPlant(North(1.5, kTop) * Place(0, -0.22, 0, 0), 0.42, room);
  const Isometry3d board = North(0.95, 1.5);
  room->Box(board, {-0.6, -0.24, 0}, {0.6, 0, 0.025}, LightWood(room));
  AddBookRow(board * Place(-0.05, -0.01, 0.025, 0), 1.0, 0.26, 0.2, room);
  AddPoster(North(-1.4, 1.75), 0.5, 0.7, room);
  AddPoster(North(-0.72, 1.78), 0.62, 0.88, room);
  AddPoster(North(-0.08, 1.66), 0.42, 0.6, room);
  AddPoster(North(0.9, 2.12), 0.6, 0.42, room);
  AddBookcase(North(2.3, 0), 1.0, 2.05, room);
  AddCarton(North(2.3, 2.06) * Place(0, -0.17, 0, 5), {0.5, 0.3, 0.28}, room);
  AddCabinet(North(-2.4, 0), 1.0, 0.45, 1.1, room);
  AddPrinter(North(-2.3, 1.1) * Place(0, -0.22, 0, 4), room);
  AddPoster(North(-2.4, 1.85), 0.7, 0.5, room);
  AddBin(Place(-0.02, 2.2, 0, 0), room);
}

void AddEastSide(RoomBuilder* room) {
  AddWindow(East(0.3, 1.6), 1.9, 1.25, room);
  AddRadiator(East(0.3, 0), 1.5, room);
  const Isometry3d desk = East(-1.55, 0);
  AddDesk(desk, 1.5, 0.7, room);
  ClutterDesk(desk, 1.5, 0.7, 5, room);
  AddMonitor(desk * Place(0.1, -0.25, kDeskHeightM, -6), 0.55, true, room);
  AddKeyboardAndMouse(desk * Place(0.05, -0.5, kDeskHeightM + 0.01, 3), room);
  AddPoster(East(-1.35, 1.75), 0.6, 0.84, room);
  AddPoster(East(-2.05, 1.7), 0.45, 0.62, room);
  AddPlant(Place(2.65, 1.55, 0, 0), 1.15, room);
}

void AddSouthSide(RoomBuilder* room) {
  AddBookcase(South(1.6, 0), 1.6, 1.9, room);
  AddPoster(South(0.2, 1.6), 0.84, 1.18, room);
  AddCabinet(South(0.15, 0), 0.9, 0.42, 0.8, room);
  AddBookStack(South(0.3, 0.8) * Place(0, -0.2, 0, 10), 5, room);
  AddPlant(South(-0.1, 0.8) * Place(0, -0.2, 0, 0), 0.4, room);
  const Isometry3d door = South(-1.5, 0);
  const int frame = WhitePlastic(room);
  room->Box(door, {-0.52, -0.04, 0}, {-0.45, 0, 2.1}, frame);
  room->Box(door, {0.45, -0.04, 0}, {0.52, 0, 2.1}, frame);
  room->Box(door, {-0.52, -0.04, 2.05}, {0.52, 0, 2.12}, frame);
  room->Picture(door, {-0.45, -0.012, 0.01}, {0.45, 0, 2.05}, Face::kFront, 1, {.shininess = 0.05f},
                [](Canvas* c) {
                  PaintDoor({120, 160, 190}, c);
                });
  AddCarton(South(-2.5, 0) * Place(0, -0.35, 0, 12), {0.6, 0.45, 0.42}, room);
  AddCarton(South(-2.45, 0.42) * Place(0, -0.34, 0, -9), {0.4, 0.36, 0.3}, room);
}

/// A whiteboard and a desk; half of the wall stays bare.
void AddWestSide(RoomBuilder* room) {
  AddWhiteboard(West(-1.0, 1.55), 1.6, 1.0, room);
  const Isometry3d desk = West(-1.0, 0);
  AddDesk(desk, 1.6, 0.7, room);
  ClutterDesk(desk, 1.6, 0.7, 6, room);
  AddMonitor(desk * Place(0.35, -0.24, kDeskHeightM, 5), 0.5, false, room);
  AddCarton(desk * Place(-0.5, -0.25, kDeskHeightM, 20), {0.32, 0.26, 0.2}, room);
  AddPoster(West(0.25, 1.6), 0.5, 0.7, room);
  room->Picture(West(1.9, 1.6), {-0.15, -0.004, -0.22}, {0.15, 0, 0.22}, Face::kFront, 1.8, {},
                [](Canvas* c) { PaintCalendar(c->Whole(), c); });
}

}  // namespace

Room MakeRoom(uint64_t seed, double texels_per_metre) {
  ORBSLAM_CHECK(texels_per_metre > 0);
  RoomBuilder builder(seed, texels_per_metre);
  AddShell(&builder);
  AddNorthSide(&builder);
  AddEastSide(&builder);
  AddSouthSide(&builder);
  AddWestSide(&builder);
  return builder.Take(OfficeLighting());
}

}  // namespace orbslam
