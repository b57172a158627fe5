// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// Where a camera was, and how well that is known.
struct UncertainPose {
  double timestamp_s = 0;
  Rigid3d world_from_camera;
  Matrix6d information = Matrix6d::Zero();  // PoseResult's; not finite: it is exact, and stays
};

/// How a camera accelerates: standard deviation, each axis. Carried by hand, as in TUM's freiburg1: 0.4 to
/// 0.6 m/s^2, 5 rad/s^2 (root mean square of the ground truth at 30 Hz).
struct MotionPrior {
  double acceleration_mps2 = 0.7;          // 0: nothing is known ...
  double angular_acceleration_radps2 = 5;  // ... likewise
};

/// Moves each pose, within what is known of it, so that the camera accelerates as cameras do: the most likely
/// trajectory if acceleration is white noise (Rauch, Tung and Striebel, AIAA Journal 1965; over poses:
/// Barfoot, Tong and Sarkka, RSS 2014). The more a jolt, or a pose that was found with wrong matches,
/// differs from what is likely, the less it counts. poses: of one motion, ascending in time. Where the numbers
/// fail they stay as they are.
void SmoothTrajectory(const MotionPrior& prior, std::span<UncertainPose> poses);

}  // namespace orbslam
