// SPDX-License-Identifier: GPL-3.0-or-later
#include "room_builder.h"

#include <array>
#include <cmath>
#include <numbers>

namespace orbslam {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A face seen from outside: its top left corner, and the edges to the right and down.
struct FaceFrame {
  Vector3d top_left, right, down;
};

FaceFrame FaceOf(const Vector3d& low, const Vector3d& high, Face face) {
  const Vector3d size = high - low;
  const Vector3d x = size.x() * Vector3d::UnitX(), y = size.y() * Vector3d::UnitY(),
                 z = size.z() * Vector3d::UnitZ();
  switch (face) {
    case Face::kFront:
      return {low + z, x, -z};
    case Face::kBack:
      return {high, -x, -z};
    case Face::kLeft:
      return {low + z + y, -y, -z};
    case Face::kRight:
      return {high - y, y, -z};
    case Face::kTop:
      return {low + z + y, x, -y};
    case Face::kBottom:
      return {low, x, y};
  }
  return {};
}

}  // namespace

Isometry3d Place(double x, double y, double z, double yaw_deg) {
  Isometry3d place = Isometry3d::Identity();
  place.translate(Vector3d(x, y, z));
  place.rotate(Eigen::AngleAxisd(yaw_deg * std::numbers::pi / 180, Vector3d::UnitZ()));
  return place;
}

RoomBuilder::RoomBuilder(uint64_t seed, double texels_per_metre)
    : texels_per_metre_(texels_per_metre), rng_(seed, 0, 0x726F6F6D) {}

std::shared_ptr<const cv::Mat> RoomBuilder::Painted(double width, double height, double detail,
                                                    const PaintFunction& paint) {
  Canvas canvas(width, height, detail * texels_per_metre_, rng_());
  paint(&canvas);
  return std::make_shared<const cv::Mat>(canvas.image());
}

int RoomBuilder::Tiled(const std::string& name, double period_m, double detail, const Material& look,
                       const PaintFunction& paint) {
  const auto [entry, is_new] = by_name_.try_emplace(name, static_cast<int>(parts_.size()));
  if (is_new) {
    parts_.push_back({look, period_m});
    parts_.back().material.texture = Painted(period_m, period_m, detail, paint);
  }
  return entry->second;
}

int RoomBuilder::Plain(const std::string& name, const Eigen::Vector3f& bgr, float shininess, float infrared) {
  const auto [entry, is_new] = by_name_.try_emplace(name, static_cast<int>(parts_.size()));
  if (is_new) parts_.push_back({Material{.color_bgr = bgr, .shininess = shininess, .infrared = infrared}});
  return entry->second;
}

void RoomBuilder::Occlude(const Isometry3d& place, const Vector3d& low, const Vector3d& high) {
  const Eigen::Matrix3d turn = place.linear();
  occluders_.push_back({place * Vector3d(0.5 * (low + high)), 0.5 * (high - low), turn(0, 0), turn(1, 0)});
}

void RoomBuilder::Box(const Isometry3d& place, const Vector3d& low, const Vector3d& high, int material) {
  Part& part = parts_[material];
  const Eigen::Vector2d offset{rng_.Uniform(), rng_.Uniform()};
  for (const Face face : {Face::kFront, Face::kBack, Face::kLeft, Face::kRight, Face::kTop, Face::kBottom}) {
    const FaceFrame frame = FaceOf(low, high, face);
    const Eigen::Vector2d size = Eigen::Vector2d(frame.right.norm(), frame.down.norm()) / part.period_m;
    part.mesh.AddQuad(place * frame.top_left, place.linear() * frame.right, place.linear() * frame.down,
                      {offset, size}, kPieceM);
  }
  Occlude(place, low, high);
}

void RoomBuilder::Picture(const Isometry3d& place, const Vector3d& low, const Vector3d& high, Face face,
                          double detail, const Material& look, const PaintFunction& paint) {
  const FaceFrame frame = FaceOf(low, high, face);
  Part part{look};
  part.material.texture = Painted(frame.right.norm(), frame.down.norm(), detail, paint);
  part.mesh.AddQuad(place * frame.top_left, place.linear() * frame.right, place.linear() * frame.down, {},
                    kPieceM);
  parts_.push_back(std::move(part));
}

Room RoomBuilder::Take(const Lighting& lighting) {
  Room room;
  room.lighting = lighting;
  for (Part& part : parts_) {
    if (part.mesh.empty()) continue;
    if (part.material.emission < 1) BakeLight(occluders_, lighting, &part.mesh.mesh());
    room.objects.push_back(
        {std::make_shared<const Mesh>(std::move(part.mesh.mesh())), part.material, Rigid3d()});
  }
  return room;
}

}  // namespace orbslam
