// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/room.h"

#include <Eigen/Geometry>
#include <numbers>

#include "canvas.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

/// A piece of furniture: an upright box that stands at height z, turned by yaw about the vertical; at yaw 0
/// its front looks along +x. Metres.
struct Box {
  double x, y, z;  // middle of its underside
  double depth, width, height;
  double yaw_deg;
  Material front, sides, top;
};

using enum Material;
constexpr Box kFurniture[] = {
    // A desk with two monitors, drawers and a carton, and a bookshelf (east, x = 3).
    {2.60, 0.30, 0.70, 0.75, 1.70, 0.04, 180, kWood, kWood, kDesktop},
    {2.60, -0.53, 0.00, 0.70, 0.03, 0.70, 180, kWood, kWood, kWood},
    {2.65, 0.90, 0.00, 0.60, 0.45, 0.62, 180, kDoors, kDoors, kDoors},
    {2.72, 0.00, 0.80, 0.05, 0.55, 0.34, 165, kScreen, kDoors, kDoors},
    {2.72, 0.60, 0.80, 0.05, 0.55, 0.34, 195, kScreen, kDoors, kDoors},
    {2.75, 0.30, 0.74, 0.20, 0.80, 0.06, 180, kBooks, kWood, kWood},
    {2.55, 1.00, 0.74, 0.25, 0.22, 0.20, 205, kCarton, kCarton, kCarton},
    {2.83, -1.50, 0.00, 0.30, 1.20, 2.00, 180, kBooks, kWood, kWood},
    // A desk with a monitor, cartons and a cupboard (north, y = 2.5).
    {-0.90, 2.10, 0.70, 0.70, 1.50, 0.04, -90, kWood, kWood, kDesktop},
    {-1.40, 2.15, 0.00, 0.60, 0.45, 0.70, -90, kDoors, kWood, kWood},
    {-0.17, 2.10, 0.00, 0.66, 0.03, 0.70, -90, kWood, kWood, kWood},
    {-1.00, 2.25, 0.74, 0.05, 0.55, 0.38, -75, kScreen, kDoors, kDoors},
    {0.60, 2.15, 0.00, 0.50, 0.55, 0.42, -70, kCarton, kCarton, kCarton},
    {0.62, 2.18, 0.42, 0.32, 0.38, 0.30, -105, kCarton, kCarton, kCarton},
    {1.80, 2.22, 0.00, 0.50, 1.10, 1.30, -90, kDoors, kWood, kWood},
    {1.65, 2.20, 1.30, 0.35, 0.45, 0.28, -80, kCarton, kCarton, kCarton},
    // A bookshelf and a plain cupboard (west, x = -3).
    {-2.83, 1.00, 0.00, 0.30, 1.50, 1.90, 0, kBooks, kWood, kWood},
    {-2.72, -0.70, 0.00, 0.50, 1.00, 1.60, 0, kDoors, kWood, kWood},
    // A sideboard with a television, and cartons (south, y = -2.5).
    {0.40, -2.25, 0.00, 0.45, 2.00, 0.75, 90, kBooks, kWood, kDesktop},
    {0.20, -2.30, 0.75, 0.06, 0.90, 0.52, 85, kScreen, kDoors, kDoors},
    {1.10, -2.25, 0.75, 0.28, 0.30, 0.24, 110, kCarton, kCarton, kCarton},
    {-1.50, -2.10, 0.00, 0.50, 0.60, 0.50, 75, kCarton, kCarton, kCarton},
    {-1.45, -2.12, 0.50, 0.36, 0.42, 0.33, 100, kCarton, kCarton, kCarton},
    // A low table in the middle.
    {0.00, 0.00, 0.00, 0.60, 0.45, 0.45, 20, kDoors, kWood, kDesktop},
};

class RoomBuilder {
 public:
  RoomBuilder(uint64_t seed, double texels_per_metre) : seed_(seed), texels_per_metre_(texels_per_metre) {}

  /// A rectangle seen against its normal, up upwards.
  void AddRectangle(const Vector3d& middle, const Vector3d& normal, const Vector3d& up, double width,
                    double height, Material material, double edge_darkening) {
    Canvas canvas(width, height, texels_per_metre_, Rng(seed_, surfaces_.size(), kPaintPurpose)());
    Paint(material, &canvas);
    const double light = 0.82 + 0.18 * normal.z() + 0.12 * normal.x() + 0.05 * normal.y();
    canvas.Shade(light, edge_darkening);
    const Vector3d edge_u = width * up.cross(normal), edge_v = -height * up;
    surfaces_.push_back({middle - 0.5 * (edge_u + edge_v), edge_u, edge_v, Texture(canvas.image())});
  }

  void AddBox(const Box& box) {
    constexpr double kEdgeDarkening = 0.15;
    const Eigen::AngleAxisd turn(box.yaw_deg * std::numbers::pi / 180.0, Vector3d::UnitZ());
    const Vector3d forward = turn * Vector3d::UnitX(), left = turn * Vector3d::UnitY(),
                   up = Vector3d::UnitZ();
    const Vector3d middle(box.x, box.y, box.z + 0.5 * box.height);
    const auto add = [&](const Vector3d& normal, const Vector3d& face_up, double reach, double width,
                         double height, Material material) {
      AddRectangle(middle + 0.5 * reach * normal, normal, face_up, width, height, material, kEdgeDarkening);
    };
    add(forward, up, box.depth, box.width, box.height, box.front);
    add(-forward, up, box.depth, box.width, box.height, box.sides);
    add(left, up, box.width, box.depth, box.height, box.sides);
    add(-left, up, box.width, box.depth, box.height, box.sides);
    add(up, left, box.height, box.depth, box.width, box.top);
    if (box.z > 0) add(-up, left, box.height, box.depth, box.width, box.sides);
  }

  void AddShell() {
    constexpr double kLength = 6.0, kWidth = 5.0, kHeight = 2.7, kEdgeDarkening = 0.35;
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), up = Vector3d::UnitZ();
    const Vector3d middle = 0.5 * kHeight * up;
    const auto add = [&](const Vector3d& inwards, const Vector3d& face_up, double distance, double width,
                         double height, Material material) {
      AddRectangle(middle - distance * inwards, inwards, face_up, width, height, material, kEdgeDarkening);
    };
    add(up, y, 0.5 * kHeight, kLength, kWidth, kFloorboards);
    add(-up, y, 0.5 * kHeight, kLength, kWidth, kCeiling);
    add(-x, up, 0.5 * kLength, kWidth, kHeight, kPlaster);
    add(x, up, 0.5 * kLength, kWidth, kHeight, kPlaster);
    add(-y, up, 0.5 * kWidth, kLength, kHeight, kPlaster);
    add(y, up, 0.5 * kWidth, kLength, kHeight, kBrick);
  }

  std::vector<Surface> Take() { return std::move(surfaces_); }

 private:
  static constexpr uint64_t kPaintPurpose = 0x7061696E;

  uint64_t seed_;
  double texels_per_metre_;
  std::vector<Surface> surfaces_;
};

}  // namespace

std::vector<Surface> MakeRoom(uint64_t seed, double texels_per_metre) {
  ORBSLAM_CHECK(texels_per_metre > 0);
  RoomBuilder builder(seed, texels_per_metre);
  builder.AddShell();
  for (const Box& box : kFurniture) builder.AddBox(box);
  return builder.Take();
}

}  // namespace orbslam
