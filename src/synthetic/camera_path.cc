// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orbslam/geometry/so3.h"
#include "orbslam/util/check.h"
#include "orbslam/util/random.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

constexpr double kTurn = 2.0 * std::numbers::pi, kDegree = kTurn / 360.0;
constexpr double kSwingS = 5.5;      // there and back, to either side, along one axis
constexpr double kHalfsphereS = 21;  // until its path closes
constexpr double kRoundS = 22.0;     // once round the room
constexpr double kOverlap = 1.1;     // of a round: its last tenth sees the first again
constexpr double kCoveredS = 2.0, kKidnappedRounds = 0.4, kAfterKidnapS = 9.0;

struct NamedMotion {
  Motion motion;
  std::string_view name;
};
constexpr std::array kMotions{
    NamedMotion{Motion::kStatic, "static"}, NamedMotion{Motion::kXyz, "xyz"},
    NamedMotion{Motion::kRpy, "rpy"},       NamedMotion{Motion::kHalfsphere, "halfsphere"},
    NamedMotion{Motion::kLoop, "loop"},     NamedMotion{Motion::kKidnap, "kidnap"}};

/// A camera upright at a place, looking along a heading (from +x towards +y), then turned in its own frame by
/// a rotation vector; radians.
struct Stance {
  Vector3d position;
  double heading = 0;
  Vector3d turn = Vector3d::Zero();
};

const Vector3d kDeskView(0.0, -0.4, 1.4);
constexpr double kToDesk = kTurn / 4, kDown = 11 * kDegree;

/// Axis i swings in the i-th third of the time: a sine to the third power, which starts and ends at rest.
Vector3d SwingInTurn(double time_s) {
  const double swings = time_s / kSwingS;
  const auto axis = static_cast<Eigen::Index>(std::fmod(std::max(swings, 0.0), 3.0));
  return std::pow(std::sin(kTurn * swings), 3) * Vector3d::Unit(axis);
}

Stance Halfsphere(double time_s) {
  constexpr double kRadiusM = 0.5, kMeanElevation = -8 * kDegree;
  const double phase = kTurn * time_s / kHalfsphereS;
  const double azimuth = 34 * kDegree * std::sin(2 * phase);
  const double elevation = kMeanElevation + 17 * kDegree * std::sin(3 * phase);
  const Vector3d outwards(-std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                          std::sin(elevation));
  return {kDeskView + kRadiusM * (outwards - Vector3d::UnitY()), kToDesk + azimuth, {elevation, 0, 0}};
}

Stance Walk(double time_s) {
  constexpr double kLongRadiusM = 1.1, kShortRadiusM = 0.75, kForwards = 35 * kDegree,
                   kDownwards = 8 * kDegree;
  const double angle = kTurn * time_s / kRoundS;
  return {{kLongRadiusM * std::cos(angle), kShortRadiusM * std::sin(angle), 1.4},
          angle + kForwards,
          {-kDownwards, 0, 0}};
}

Stance Choreography(Motion motion, double time_s) {
  switch (motion) {
    case Motion::kStatic:
      return {kDeskView, kToDesk, {-kDown, 0, 0}};
    case Motion::kXyz:
      return {kDeskView + 0.3 * SwingInTurn(time_s), kToDesk, {-kDown, 0, 0}};
    case Motion::kRpy: {
      const Vector3d rpy = 25 * kDegree * SwingInTurn(time_s);
      return {kDeskView, kToDesk, {rpy[1] - kDown, rpy[2], rpy[0]}};
    }
    case Motion::kHalfsphere:
      return Halfsphere(time_s);
    case Motion::kLoop:
      return Walk(time_s);
    case Motion::kKidnap:
      return Walk(time_s < kRoundS + 0.5 * kCoveredS ? time_s : time_s + kKidnappedRounds * kRoundS);
  }
  ORBSLAM_CHECK(false);
  return {};
}

}  // namespace

std::optional<Motion> ParseMotion(std::string_view name) {
  const auto found = std::ranges::find(kMotions, name, &NamedMotion::name);
  return found == kMotions.end() ? std::nullopt : std::optional(found->motion);
}

std::string_view MotionName(Motion motion) {
  return std::ranges::find(kMotions, motion, &NamedMotion::motion)->name;
}

std::span<const Motion> AllMotions() {
  static const auto motions = [] {
    std::array<Motion, kMotions.size()> all;
    std::ranges::transform(kMotions, all.begin(), &NamedMotion::motion);
    return all;
  }();
  return motions;
}

double MotionDurationS(Motion motion) {
  switch (motion) {
    case Motion::kStatic:
      return 12;
    case Motion::kXyz:
    case Motion::kRpy:
      return 3 * kSwingS;
    case Motion::kHalfsphere:
      return kHalfsphereS;
    case Motion::kLoop:
      return kOverlap * kRoundS;
    case Motion::kKidnap:
      return kRoundS + kCoveredS + kAfterKidnapS;
  }
  ORBSLAM_CHECK(false);
  return 0;
}

CameraPath::CameraPath(Motion motion, uint64_t seed) : motion_(motion) {
  constexpr uint64_t kTremorPurpose = 0x74726D72;
  // Slow sway, and the faster the smaller.
  constexpr std::array<double, kNumWaves> kHertz{0.25, 0.6, 1.3, 3.0}, kWeights{0.45, 0.3, 0.18, 0.07};
  Rng rng(seed, 0, kTremorPurpose);
  for (auto& waves : tremor_) {
    for (int i = 0; i < kNumWaves; ++i) {
      const double hertz = kHertz[i] * rng.Uniform(0.7, 1.4), phase = rng.Uniform(0, kTurn);
      waves[i] = {kTurn * hertz, phase, kWeights[i]};
    }
  }
}

bool CameraPath::IsCovered(double time_s) const {
  return motion_ == Motion::kKidnap && time_s >= kRoundS && time_s < kRoundS + kCoveredS;
}

Eigen::Matrix<double, 6, 1> CameraPath::Tremor(double time_s) const {
  Eigen::Matrix<double, 6, 1> sums = Eigen::Matrix<double, 6, 1>::Zero();
  for (size_t i = 0; i < tremor_.size(); ++i) {
    for (const Wave& wave : tremor_[i]) {
      sums[i] += wave.weight * std::sin(wave.angular_frequency * time_s + wave.phase);
    }
  }
  return sums;
}

Rigid3d CameraPath::WorldFromCamera(double time_s) const {
  constexpr double kTremorM = 0.008, kTremorRad = 0.6 * kDegree;
  Stance stance = Choreography(motion_, time_s);
  const auto tremor = Tremor(time_s);
  stance.position += kTremorM * tremor.head<3>();
  stance.turn += kTremorRad * tremor.tail<3>();
  Eigen::Matrix3d ahead;  // columns: the camera's right, down and forward axes in the world at heading 0
  ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Quaterniond heading(Eigen::AngleAxisd(stance.heading, Vector3d::UnitZ()));
  return {(heading * Eigen::Quaterniond(ahead) * So3Exp(stance.turn)).normalized(), stance.position};
}

}  // namespace orbslam
