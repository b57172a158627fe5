// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "room_builder.h"

namespace orbslam {

// Furniture stands on the floor at the origin of `place`, its back edge's middle there, its front towards -y.

constexpr double kDeskHeightM = 0.74;

void AddDesk(const Eigen::Isometry3d& place, double width, double depth, RoomBuilder* room);
/// An open shelf, full of books and folders.
void AddBookcase(const Eigen::Isometry3d& place, double width, double height, RoomBuilder* room);
/// A row of books on a board.
void AddBookRow(const Eigen::Isometry3d& place, double width, double height, double depth, RoomBuilder* room);
void AddCabinet(const Eigen::Isometry3d& place, double width, double depth, double height, RoomBuilder* room);
/// An office chair; its seat's middle is at the origin.
void AddChair(const Eigen::Isometry3d& place, RoomBuilder* room);
/// A screen, stand and all; on a desk.
void AddMonitor(const Eigen::Isometry3d& place, double width, bool is_on, RoomBuilder* room);
/// Flat on a wall: y = 0 is the wall, the origin the picture's middle.
void AddPoster(const Eigen::Isometry3d& place, double width, double height, RoomBuilder* room);
void AddWhiteboard(const Eigen::Isometry3d& place, double width, double height, RoomBuilder* room);
void AddWindow(const Eigen::Isometry3d& place, double width, double height, RoomBuilder* room);
void AddRadiator(const Eigen::Isometry3d& place, double width, RoomBuilder* room);

/// Materials by what they are.
int LightWood(RoomBuilder* room);
int Metal(RoomBuilder* room);
int BlackPlastic(RoomBuilder* room);
int WhitePlastic(RoomBuilder* room);

}  // namespace orbslam
