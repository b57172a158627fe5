// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/camera_path.h"

#include <cmath>
#include <numbers>

#include "orbslam/geometry/so3.h"
#include "orbslam/util/check.h"
#include "orbslam/util/random.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

constexpr double kTurn = 2.0 * std::numbers::pi, kDegree = kTurn / 360.0;
constexpr double kSwingS = 5.5;   // there and back, to either side, along one axis
constexpr double kRoundS = 22.0;  // once round the room
constexpr double kOverlap = 1.1;  // of a round: its last tenth sees the first again

/// A camera upright at a place, looking along a heading (from +x towards +y), then turned in its own frame by
/// a rotation vector; radians.
struct Stance {
  Vector3d position;
  double heading = 0;
  Vector3d turn = Vector3d::Zero();
};

/// Axis i swings in the i-th third of the time: a sine to the third power, which starts and ends at rest.
Vector3d SwingInTurn(double time_s) {
  const double swings = time_s / kSwingS;
  const auto axis = static_cast<Eigen::Index>(std::fmod(swings, 3.0));
  return std::pow(std::sin(kTurn * swings), 3) * Vector3d::Unit(axis);
}

Stance Walk(double time_s) {
  constexpr double kLongRadiusM = 1.1, kShortRadiusM = 0.75, kForwards = 35 * kDegree, kDown = 6 * kDegree;
  const double angle = kTurn * time_s / kRoundS;
  return {{kLongRadiusM * std::cos(angle), kShortRadiusM * std::sin(angle), 1.4},
          angle + kForwards,
          {-kDown, 0, 0}};
}

Stance Choreography(Motion motion, double time_s) {
  const Vector3d desk_view(0.7, 0.2, 1.3);
  constexpr double kDown = 8 * kDegree;
  switch (motion) {
    case Motion::kXyz:
      return {desk_view + 0.3 * SwingInTurn(time_s), 0, {-kDown, 0, 0}};
    case Motion::kRpy: {
      const Vector3d rpy = 25 * kDegree * SwingInTurn(time_s);
      return {desk_view, 0, {rpy[1] - kDown, rpy[2], rpy[0]}};
    }
    case Motion::kLoop:
      return Walk(time_s);
    case Motion::kStatic:
      return {desk_view, 0, {-kDown, 0, 0}};
  }
  ORBSLAM_CHECK(false);
  return {};
}

}  // namespace

std::optional<Motion> ParseMotion(std::string_view name) {
  if (name == "xyz") return Motion::kXyz;
  if (name == "rpy") return Motion::kRpy;
  if (name == "loop") return Motion::kLoop;
  if (name == "static") return Motion::kStatic;
  return std::nullopt;
}

double MotionDurationS(Motion motion) {
  if (motion == Motion::kStatic) return 5.0;
  return motion == Motion::kLoop ? kOverlap * kRoundS : 3.0 * kSwingS;
}

CameraPath::CameraPath(Motion motion, uint64_t seed) : motion_(motion) {
  constexpr uint64_t kTremorPurpose = 0x74726D72;
  Rng rng(seed, 0, kTremorPurpose);
  for (auto& waves : tremor_) {
    for (Wave& wave : waves) wave = {kTurn * rng.Uniform(0.3, 1.5), rng.Uniform(0, kTurn)};
  }
}

Eigen::Matrix<double, 6, 1> CameraPath::Tremor(double time_s) const {
  Eigen::Matrix<double, 6, 1> sums = Eigen::Matrix<double, 6, 1>::Zero();
  for (size_t i = 0; i < tremor_.size(); ++i) {
    for (const Wave& wave : tremor_[i]) sums[i] += std::sin(wave.angular_frequency * time_s + wave.phase);
  }
  return sums / kNumWaves;
}

Rigid3d CameraPath::WorldFromCamera(double time_s) const {
  constexpr double kTremorM = 0.005, kTremorRad = 0.3 * kDegree;
  Stance stance = Choreography(motion_, time_s);
  if (motion_ != Motion::kStatic) {
    const auto tremor = Tremor(time_s);
    stance.position += kTremorM * tremor.head<3>();
    stance.turn += kTremorRad * tremor.tail<3>();
  }
  Eigen::Matrix3d ahead;  // columns: the camera's right, down and forward axes in the world at heading 0
  ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Quaterniond heading(Eigen::AngleAxisd(stance.heading, Vector3d::UnitZ()));
  return {(heading * Eigen::Quaterniond(ahead) * So3Exp(stance.turn)).normalized(), stance.position};
}

}  // namespace orbslam
