// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/util/result.h"

namespace orbslam {

struct StampedPose {
  std::string timestamp_text;  // seconds, as the sequence writes it
  Rigid3d world_from_camera;
};

/// Writes "timestamp tx ty tz qx qy qz qw" a line, TUM's format: metres, 9 decimals, of q and -q the one with
/// qw >= 0. The file appears when it is complete (WriteFileAtomically). Error: cannot be written, or a pose
/// is not finite; then nothing is written.
Status WriteTrajectory(const std::string& path, std::span<const StampedPose> trajectory);

/// Reads the same format; separators, comments and line ends as in ReadTumSequence(). Quaternions are
/// normalised. Error, with the line: not 8 finite numbers, or a quaternion that is not of unit length to 1 %.
Result<std::vector<StampedPose>> ReadTrajectory(const std::string& path);

}  // namespace orbslam
