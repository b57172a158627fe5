// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/gait.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn = 2.0 * std::numbers::pi, kDegree = kTurn / 360.0;

}  // namespace

Vector2d Ahead(double heading) { return {std::cos(heading), std::sin(heading)}; }
Vector2d LeftOf(double heading) { return {-std::sin(heading), std::cos(heading)}; }

double SmoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

LegAngles WalkingAngles(double phase) {
  // Degrees: mean, then cosine and sine of each harmonic.
  constexpr double kHip[9] = {7.3, 15.8, -2.9, -2.7, -1.4, 0.0, 1.2, -0.1, -0.2};
  constexpr double kKnee[9] = {24.2, -4.0, -20.4, -14.1, 7.8, -1.0, 3.4, -0.7, 0.7};
  constexpr double kAnkle[9] = {-1.1, -0.4, 6.4, 0.6, -7.0, -2.4, 1.4, 2.1, -1.1};
  const auto series = [phase](const double(&c)[9]) {
    double sum = c[0];
    for (int k = 1; k <= 4; ++k) {
      sum += c[2 * k - 1] * std::cos(kTurn * k * phase) + c[2 * k] * std::sin(kTurn * k * phase);
    }
    return sum * kDegree;
  };
  return {series(kHip), series(kKnee), series(kAnkle)};
}

Vector3d SolePoint(const FootShape& shape, const FootState& foot, double along) {
  const double s = std::sin(foot.pitch), c = std::cos(foot.pitch);
  const double forward = along * c + shape.ankle_height * s;
  return foot.ankle + Vector3d(forward * std::cos(foot.heading), forward * std::sin(foot.heading),
                               along * s - shape.ankle_height * c);
}

}  // namespace orbslam
