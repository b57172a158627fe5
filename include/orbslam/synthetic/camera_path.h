// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// The first four are those of TUM's freiburg3 sequences (Sturm et al., IROS 2012), with about their speeds:
/// all look at the main desk from 2 m before it.
enum class Motion {
  kStatic,      // held in place by hand
  kXyz,         // swings of 0.3 m to either side along the world's x, y and z in turn
  kRpy,         // swings of 25 degrees to either side about the camera's z, x and y in turn, from one place
  kHalfsphere,  // over a half sphere of 1 m diameter, looking outwards
  kLoop,        // a walk round the middle of the room, looking forwards and outwards; the last tenth sees the
                // start again
  kKidnap,      // the round of kLoop, then covered for 2 s, then elsewhere on the round
};

/// "static", "xyz", "rpy", "halfsphere", "loop" or "kidnap".
std::optional<Motion> ParseMotion(std::string_view name);
std::string_view MotionName(Motion motion);
std::span<const Motion> AllMotions();

/// Seconds after which the motion has shown everything it has.
double MotionDurationS(Motion motion);

/// A hand-held camera's path through the room of MakeRoom: smooth (C1) while it is not covered, at most 0.6
/// m/s and 60 degrees/s. A pure function of (motion, seed, time); the seed makes the hand's tremor.
class CameraPath {
 public:
  CameraPath(Motion motion, uint64_t seed);

  Rigid3d WorldFromCamera(double time_s) const;
  /// Whether a hand covers the lens: nothing is seen.
  bool IsCovered(double time_s) const;

 private:
  static constexpr int kNumWaves = 4;
  struct Wave {
    double angular_frequency = 0, phase = 0, weight = 0;  // rad/s, rad
  };

  /// Sums of sines in [-1, 1]^6: three for the position, three for the rotation.
  Eigen::Matrix<double, 6, 1> Tremor(double time_s) const;

  Motion motion_;
  std::array<std::array<Wave, kNumWaves>, 6> tremor_;
};

}  // namespace orbslam
