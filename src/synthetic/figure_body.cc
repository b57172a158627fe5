// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "figure_mesh.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

std::vector<Section> Scaled(std::vector<Section> sections, double scale) {
  for (Section& s : sections) {
    s = {s.z * scale, s.radius_x * scale, s.radius_y * scale, s.center_x * scale, s.center_y * scale};
  }
  return sections;
}

/// Lays a loft down: what rose now goes ahead, what was ahead is up.
Mesh LaidDown(Mesh mesh) {
  Eigen::Isometry3d lay = Eigen::Isometry3d::Identity();
  lay.linear() << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  Transform(lay, &mesh);
  return mesh;
}

/// Flattens what is below a sole.
void Flatten(double sole_z, Mesh* mesh) {
  Displace(
      [sole_z](const Vertex& v) {
        return Vector3d(0, 0, std::max(0.0, sole_z - static_cast<double>(v.position.z())));
      },
      mesh);
}

double Bump(double a, double width_a, double b, double width_b) {
  return std::exp(-a * a / (width_a * width_a) - b * b / (width_b * width_b));
}

const std::vector<Section>& Skull() {
  static const std::vector<Section> kSkull = {{0.036, 0.040, 0.036, 0.038}, {0.055, 0.064, 0.050, 0.028},
                                              {0.080, 0.079, 0.060, 0.019}, {0.110, 0.089, 0.067, 0.012},
                                              {0.145, 0.097, 0.074, 0.004}, {0.180, 0.101, 0.077, 0.000},
                                              {0.205, 0.097, 0.074, -0.003}};
  return kSkull;
}
constexpr LoftDetail kSkullDetail = {56, 36, 1, 1, true, true};
constexpr double kCrownZ = 0.264, kChinZ = 0.007;
constexpr double kBrowsZ = 0.161, kEyesZ = 0.144, kNoseZ = 0.110, kMouthZ = 0.082;

/// How far the face stands out of the skull at a place, metres.
double Relief(double y, double z) {
  const double nose = 0.021 * Bump(y, 0.012, z - kNoseZ, 0.012) + 0.012 * Bump(y, 0.010, z - 0.128, 0.016);
  const double sockets = 0.006 * Bump(std::abs(y) - 0.031, 0.014, z - kEyesZ, 0.010);
  const double brows = 0.004 * Bump(std::abs(y) - 0.028, 0.022, z - 0.163, 0.008);
  const double mouth = 0.004 * Bump(y, 0.022, z - kMouthZ, 0.010) - 0.003 * Bump(y, 0.018, z - 0.066, 0.006);
  const double chin = 0.006 * Bump(y, 0.018, z - 0.048, 0.012);
  return nose - sockets + brows + mouth + chin;
}

/// The hair's edge: over the forehead, down before the ears, low in the neck. angle 0 is ahead.
double HairLine(double angle) {
  const double a = std::abs(angle) * 180 / std::numbers::pi;
  if (a < 55) return 0.204 - 0.016 * SmoothStep(a / 55);
  if (a < 80) return 0.188 - 0.054 * SmoothStep((a - 55) / 25);
  return a < 110 ? 0.134 + 0.004 * (a - 80) / 30 : 0.138 - 0.068 * SmoothStep((a - 110) / 40);
}

}  // namespace

FaceRows BodyMeshes::Rows() {
  const auto row = [](double z) { return (kCrownZ - z) / (kCrownZ - kChinZ); };
  return {row(kBrowsZ), row(kEyesZ), row(kNoseZ), row(kMouthZ)};
}

Mesh BodyMeshes::Limb(std::vector<Section> sections, int around, int along) const {
  sections = Scaled(std::move(sections), scale_);
  const Section& middle = sections[sections.size() / 2];
  const double girth = std::numbers::pi * (middle.radius_x + middle.radius_y);
  const double length = sections.back().z - sections.front().z + 0.8 * (middle.radius_x + middle.radius_y);
  return Loft(sections, {around, along, std::max(1.0, std::round(girth / kClothTileM)), length / kClothTileM,
                         true, true});
}

Mesh BodyMeshes::Hips() const {
  return Limb({{-0.085, 0.085, 0.125, -0.010},
               {-0.030, 0.112, 0.162, -0.010},
               {0.040, 0.104, 0.158, -0.008},
               {0.120, 0.086, 0.136, 0}},
              28, 8);
}

Mesh BodyMeshes::Shirt() const {
  const std::vector<Section> sections = {
      {-0.140, 0.130, 0.186, -0.006}, {-0.030, 0.121, 0.172, -0.002}, {0.090, 0.110, 0.156, 0.004},
      {0.210, 0.119, 0.164, 0.006},   {0.300, 0.120, 0.172, 0.000},   {0.350, 0.108, 0.184, -0.008},
      {0.388, 0.092, 0.186, -0.014},  {0.418, 0.078, 0.156, -0.016},  {0.438, 0.068, 0.106, -0.016},
      {0.454, 0.061, 0.074, -0.013},  {0.474, 0.057, 0.061, -0.011}};
  return Loft(Scaled(sections, scale_), {36, 36, 1, 1, false, false});
}

Mesh BodyMeshes::Neck() const {
  return Loft(
      Scaled({{-0.060, 0.050, 0.052, -0.014}, {0.010, 0.050, 0.050, -0.010}, {0.080, 0.052, 0.049, 0}},
             scale_),
      {20, 5, 1, 1, true, true});
}

Mesh BodyMeshes::Face() const {
  Mesh face = Loft(Skull(), kSkullDetail);
  Displace(
      [](const Vertex& v) -> Vector3d {
        if (v.position.x() < 0) return Vector3d::Zero();
        return {Relief(v.position.y(), v.position.z()), 0, 0};
      },
      &face);
  Transform(Eigen::Isometry3d(Eigen::Scaling(scale_)), &face);
  return face;
}

Mesh BodyMeshes::Ears() const {
  Mesh ears = Ellipsoid({-0.008, 0.076, 0.135}, {0.019, 0.010, 0.030}, 12, 5);
  Mesh right = ears;
  MirrorY(&right);
  Append(right, &ears);
  Transform(Eigen::Isometry3d(Eigen::Scaling(scale_)), &ears);
  return ears;
}

Mesh BodyMeshes::Hair() const {
  LoftDetail detail = kSkullDetail;
  detail.repeats_u = 3;
  Mesh hair = Loft(Skull(), detail);
  Displace(
      [](const Vertex& v) -> Vector3d {
        const double angle = std::atan2(v.position.y(), v.position.x()), z = v.position.z();
        constexpr double kThickM = 0.013, kUnderSkinM = 0.010, kEdgeM = 0.022;
        const double inside = SmoothStep((z - HairLine(angle)) / kEdgeM + 0.5);
        const double locks = 0.003 * std::sin(23 * angle + 60 * z) * inside;
        return (inside * (kThickM + kUnderSkinM) - kUnderSkinM + locks) * v.normal.cast<double>();
      },
      &hair);
  Transform(Eigen::Isometry3d(Eigen::Scaling(scale_)), &hair);
  return hair;
}

Mesh BodyMeshes::UpperArm() const {
  const double elbow = -size_.upper_arm / scale_;
  return Limb({{elbow, 0.044, 0.043},
               {-0.20, 0.048, 0.045},
               {-0.09, 0.053, 0.049},
               {-0.05, 0.052, 0.048},
               {-0.022, 0.046, 0.042}},
              18, 8);
}

Mesh BodyMeshes::Forearm() const {
  const double wrist = -size_.forearm / scale_;
  return Limb(
      {{wrist - 0.005, 0.034, 0.033}, {wrist + 0.03, 0.036, 0.034}, {-0.08, 0.044, 0.041}, {0, 0.044, 0.043}},
      18, 7);
}

Mesh BodyMeshes::Hand() const {
  Mesh hand = Loft(
      std::vector<Section>{
          {-0.088, 0.040, 0.011}, {-0.050, 0.041, 0.014}, {-0.015, 0.029, 0.017}, {0.010, 0.025, 0.020}},
      {16, 8, 1, 1, true, true});
  constexpr double kLengths[4] = {0.070, 0.078, 0.072, 0.056};
  for (int i = 0; i < 4; ++i) {
    const double x = 0.030 - 0.0195 * i, length = kLengths[i];
    const Vector3d knuckle(x, 0, -0.085), middle(x, -0.008, -0.085 - 0.5 * length);
    Append(Rod(knuckle, middle, 0.0092, 6), &hand);
    Append(Rod(middle, {0.95 * x, -0.030, -0.085 - 0.9 * length}, 0.0082, 6), &hand);
  }
  Append(Rod({0.026, -0.004, -0.025}, {0.052, -0.014, -0.062}, 0.0115, 6), &hand);
  Append(Rod({0.052, -0.014, -0.062}, {0.055, -0.022, -0.092}, 0.0095, 6), &hand);
  Transform(Eigen::Isometry3d(Eigen::Scaling(scale_)), &hand);
  return hand;
}

Mesh BodyMeshes::Thigh() const {
  const double knee = -size_.thigh / scale_;
  return Limb({{knee, 0.060, 0.059}, {-0.27, 0.070, 0.067}, {-0.10, 0.084, 0.079}, {0.0, 0.088, 0.080}}, 20,
              9);
}

Mesh BodyMeshes::Shin() const {
  const double ankle = -size_.shin / scale_;
  return Limb({{ankle - 0.012, 0.060, 0.053, 0.004},
               {-0.30, 0.057, 0.053},
               {-0.12, 0.063, 0.058, -0.008},
               {0.0, 0.061, 0.059}},
              20, 9);
}

Mesh BodyMeshes::Shoe() const {
  Mesh shoe = Loft(std::vector<Section>{{-0.048, 0.044, 0.030, -0.050},
                                        {-0.010, 0.060, 0.037, -0.042},
                                        {0.040, 0.056, 0.039, -0.048},
                                        {0.075, 0.044, 0.043, -0.058},
                                        {0.097, 0.034, 0.046, -0.063}},
                   {20, 10, 1, 1, true, true});
  shoe = LaidDown(std::move(shoe));
  Flatten(-0.085, &shoe);
  Transform(Eigen::Isometry3d(Eigen::Scaling(scale_)), &shoe);
  return shoe;
}

Mesh BodyMeshes::ShoeTip() const {
  Mesh tip = Loft(
      std::vector<Section>{
          {-0.020, 0.033, 0.0465, 0.020}, {0.020, 0.030, 0.044, 0.016}, {0.052, 0.024, 0.034, 0.013}},
      {20, 6, 1, 1, true, true});
  tip = LaidDown(std::move(tip));
  Flatten(0.0, &tip);
  Transform(Eigen::Isometry3d(Eigen::Scaling(scale_)), &tip);
  return tip;
}

}  // namespace orbslam
