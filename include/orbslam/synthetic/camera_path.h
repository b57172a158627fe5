// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

enum class Motion {
  kXyz,   // swings of 0.3 m to either side along the world's x, y and z in turn, looking at a desk
  kRpy,   // swings of 25 degrees to either side about the camera's z, x and y in turn, from one place
  kLoop,  // a walk round the middle of the room, looking forwards and outwards; the last tenth sees the start
          // again
  kStatic,  // on a tripod
};

/// "xyz", "rpy", "loop" or "static".
std::optional<Motion> ParseMotion(std::string_view name);

/// Seconds after which the motion has shown everything it has.
double MotionDurationS(Motion motion);

/// A hand-held camera's path through the room of MakeRoom: smooth (C1) for all times, at most 0.5 m/s and
/// 40 degrees/s. A pure function of (motion, seed, time); the seed makes the hand's tremor.
class CameraPath {
 public:
  CameraPath(Motion motion, uint64_t seed);

  Rigid3d WorldFromCamera(double time_s) const;

 private:
  static constexpr int kNumWaves = 3;
  struct Wave {
    double angular_frequency = 0, phase = 0;  // rad/s, rad
  };

  /// Sums of sines in [-1, 1]^6: three for the position, three for the rotation.
  Eigen::Matrix<double, 6, 1> Tremor(double time_s) const;

  Motion motion_;
  std::array<std::array<Wave, kNumWaves>, 6> tremor_;
};

}  // namespace orbslam
