// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "orbslam/synthetic/figure.h"

namespace orbslam {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond About(const Vector3d& axis, double angle) { return Quaterniond(AngleAxisd(angle, axis)); }
Quaterniond Yaw(double angle) { return About(Vector3d::UnitZ(), angle); }
Quaterniond PitchDown(double angle) { return About(Vector3d::UnitY(), angle); }

/// The rotation with z along `up` and x as near as can be to `ahead`.
Quaterniond Upright(const Vector3d& up, const Vector3d& ahead) {
  Matrix3d axes;
  axes.col(2) = up.normalized();
  axes.col(1) = axes.col(2).cross(ahead).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return Quaterniond(axes);
}

struct TwoLinks {
  Quaterniond upper, lower;
  Vector3d middle, end;
};

/// Links of lengths a and b from `root` towards `target`, bent so that the joint between them goes towards
/// `pole`; x of both looks along x_sign * pole. A target out of reach is approached.
TwoLinks Reach(const Vector3d& root, const Vector3d& target, double a, double b, const Vector3d& pole,
               double x_sign) {
  const Vector3d way = target - root;
  const double length = std::clamp(way.norm(), std::abs(a - b) + 1e-3, a + b - 1e-6);
  const Vector3d along = way.normalized();
  const double share = (a * a - b * b + length * length) / (2 * length);
  const Vector3d out = (pole - pole.dot(along) * along).normalized();
  TwoLinks links;
  links.middle = root + share * along + std::sqrt(std::max(0.0, a * a - share * share)) * out;
  links.end = root + length * along;
  links.upper = Upright(root - links.middle, x_sign * out);
  links.lower = Upright(links.middle - links.end, x_sign * out);
  return links;
}

Vector3d Ahead3(double heading) { return {std::cos(heading), std::sin(heading), 0}; }

/// Smooth minimum: below both by up to k ln 2.
double SoftMin(double a, double b, double k) {
  const double low = std::min(a, b);
  return low - k * std::log1p(std::exp((low - std::max(a, b)) / k));
}

/// The pelvis over, or behind and below, the feet.
Rigid3d PlacePelvis(const BodySize& size, const GaitState& gait, const UpperBody& upper) {
  const double heading = gait.body.heading + upper.pelvis_yaw;
  const Vector3d left(-std::sin(gait.body.heading), std::cos(gait.body.heading), 0);
  const Vector3d ground(gait.body.position.x(), gait.body.position.y(), 0);
  Rigid3d pelvis{Yaw(heading), ground + gait.sway_m * left};
  constexpr double kStraight = 0.992, kSoftM = 0.004;  // knees are never locked
  const double reach = kStraight * (size.thigh + size.shin);
  double height = size.foot.ankle_height + reach;
  for (int side = 0; side < 2; ++side) {
    const Vector3d hip = pelvis * Vector3d(0, side == 0 ? size.half_hips : -size.half_hips, 0);
    const Vector3d& ankle = gait.feet[side].ankle;
    const double away = (hip - ankle).head<2>().norm();
    const double highest = ankle.z() + std::sqrt(std::max(0.0, reach * reach - away * away));
    height = SoftMin(height, highest, kSoftM);
  }
  const Vector3d back = -SeatedHipsBack(size) * Ahead3(gait.body.heading);
  pelvis.translation += gait.seated * back;
  // Sitting down, the hips go back first and then down: a quarter of an ellipse keeps the legs in reach.
  const double drop = 1 - std::sqrt(1 - gait.seated * gait.seated);
  pelvis.translation.z() = height + drop * (SeatedHipsHeight() - height);
  pelvis.rotation = pelvis.rotation * PitchDown(-0.2 * gait.seated);
  return pelvis;
}

void PlaceLeg(const BodySize& size, const FootState& foot, int side, BodyPose* pose) {
  const Vector3d hip = (*pose)[kPelvis] * Vector3d(0, side == 0 ? size.half_hips : -size.half_hips, 0);
  const double apart = side == 0 ? 0.1 : -0.1;  // knees point a little outwards
  const TwoLinks leg = Reach(hip, foot.ankle, size.thigh, size.shin, Ahead3(foot.heading + apart), 1);
  (*pose)[kThighLeft + side] = {leg.upper, hip};
  (*pose)[kShinLeft + side] = {leg.lower, leg.middle};
  (*pose)[kFootLeft + side] = {Yaw(foot.heading) * PitchDown(-foot.pitch), leg.end};
  const Vector3d ball = (*pose)[kFootLeft + side] * Vector3d(size.foot.ball, 0, -size.foot.ankle_height);
  (*pose)[kToesLeft + side] = {Yaw(foot.heading) * PitchDown(-foot.toe_pitch), ball};
}

void PlaceArm(const BodySize& size, const ArmControl& arm, int side, BodyPose* pose) {
  const double out = side == 0 ? 1 : -1;
  const Rigid3d& torso = (*pose)[kTorso];
  const Vector3d shoulder = torso * Vector3d(0, out * size.half_shoulders, size.shoulder_height);
  Quaterniond upper = torso.rotation * About(Vector3d::UnitX(), out * arm.abduction) *
                      PitchDown(-arm.flexion) * Yaw(-out * arm.turn);
  Quaterniond fore = upper * PitchDown(-arm.elbow);
  Vector3d elbow = shoulder - upper * Vector3d(0, 0, size.upper_arm);
  Vector3d wrist = elbow - fore * Vector3d(0, 0, size.forearm);
  if (arm.wrist && arm.wrist_weight > 0) {
    const Vector3d target = wrist + arm.wrist_weight * (*arm.wrist - wrist);
    const Vector3d pole = torso.rotation * Vector3d(-0.8, 0.5 * out, -0.6);
    const TwoLinks links = Reach(shoulder, target, size.upper_arm, size.forearm, pole, -1);
    const double w = arm.wrist_weight;
    upper = upper.slerp(w, links.upper);
    elbow = shoulder - upper * Vector3d(0, 0, size.upper_arm);
    fore = w < 1 ? fore.slerp(w, links.lower) : links.lower;
    wrist = elbow - fore * Vector3d(0, 0, size.forearm);
  }
  (*pose)[kUpperArmLeft + side] = {upper, shoulder};
  (*pose)[kForearmLeft + side] = {fore, elbow};
  (*pose)[kHandLeft + side] = {fore * About(Vector3d::UnitX(), -0.1 * out), wrist};
}

}  // namespace

BodySize::BodySize(double height_m)
    : height(height_m),
      thigh(0.245 * height_m),
      shin(0.246 * height_m),
      half_hips(0.052 * height_m),
      half_stance(0.056 * height_m),
      waist(0.055 * height_m),
      shoulder_height(0.225 * height_m),
      half_shoulders(0.104 * height_m),
      neck_height(0.256 * height_m),
      upper_arm(0.176 * height_m),
      forearm(0.146 * height_m),
      hand(0.108 * height_m) {
  const double scale = height_m / 1.75;
  foot = {0.085 * scale, 0.058 * scale, 0.125 * scale, 0.200 * scale};
}

double SeatedHipsBack(const BodySize& size) { return 0.8 * size.thigh; }
double SeatedHipsHeight() { return 0.55; }

std::vector<BodyJoint> BodyJoints(const BodySize& size) {
  std::vector<BodyJoint> joints = {{kPelvis, kTorso, {0, 0, size.waist}},
                                   {kTorso, kHead, {0, 0, size.neck_height}}};
  const auto add = [&joints](int parent, int child, const Vector3d& in_parent) {
    joints.push_back({static_cast<BodyPart>(parent), static_cast<BodyPart>(child), in_parent});
  };
  for (int side = 0; side < 2; ++side) {
    const double out = side == 0 ? 1 : -1;
    add(kTorso, kUpperArmLeft + side, {0, out * size.half_shoulders, size.shoulder_height});
    add(kUpperArmLeft + side, kForearmLeft + side, {0, 0, -size.upper_arm});
    add(kForearmLeft + side, kHandLeft + side, {0, 0, -size.forearm});
    add(kPelvis, kThighLeft + side, {0, out * size.half_hips, 0});
    add(kThighLeft + side, kShinLeft + side, {0, 0, -size.thigh});
    add(kShinLeft + side, kFootLeft + side, {0, 0, -size.shin});
    add(kFootLeft + side, kToesLeft + side, {size.foot.ball, 0, -size.foot.ankle_height});
  }
  return joints;
}

BodyPose SolveBodyPose(const BodySize& size, const GaitState& gait, const UpperBody& upper) {
  BodyPose pose;
  pose[kPelvis] = PlacePelvis(size, gait, upper);
  const double facing = gait.body.heading + upper.torso_yaw;
  const Quaterniond torso =
      Yaw(facing) * PitchDown(upper.torso_pitch) * About(Vector3d::UnitX(), upper.torso_roll);
  pose[kTorso] = {torso, pose[kPelvis] * Vector3d(0, 0, size.waist)};
  // The head keeps level, whatever the torso does.
  pose[kHead] = {Yaw(facing + upper.head_yaw) * PitchDown(upper.head_pitch + 0.3 * upper.torso_pitch),
                 pose[kTorso] * Vector3d(0, 0, size.neck_height)};
  for (int side = 0; side < 2; ++side) {
    PlaceLeg(size, gait.feet[side], side, &pose);
    PlaceArm(size, upper.arms[side], side, &pose);
  }
  return pose;
}

}  // namespace orbslam
