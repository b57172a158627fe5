// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "room_builder.h"

namespace orbslam {

// Small things; each stands at the origin of `place`.

void AddMug(const Eigen::Isometry3d& place, RoomBuilder* room);
void AddBottle(const Eigen::Isometry3d& place, RoomBuilder* room);
void AddPaper(const Eigen::Isometry3d& place, RoomBuilder* room);
void AddBookStack(const Eigen::Isometry3d& place, int num_books, RoomBuilder* room);
void AddKeyboardAndMouse(const Eigen::Isometry3d& place, RoomBuilder* room);
void AddCarton(const Eigen::Isometry3d& place, const Eigen::Vector3d& size, RoomBuilder* room);
void AddPlant(const Eigen::Isometry3d& place, double height, RoomBuilder* room);
void AddDeskLamp(const Eigen::Isometry3d& place, RoomBuilder* room);
void AddPenHolder(const Eigen::Isometry3d& place, RoomBuilder* room);
void AddBin(const Eigen::Isometry3d& place, RoomBuilder* room);
void AddPrinter(const Eigen::Isometry3d& place, RoomBuilder* room);
/// A cable that droops between two points of the world.
void AddCable(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double droop, RoomBuilder* room);

/// What people leave on a desk of this size (AddDesk's place); keeps off its back third.
void ClutterDesk(const Eigen::Isometry3d& desk, double width, double depth, int density, RoomBuilder* room);

}  // namespace orbslam
