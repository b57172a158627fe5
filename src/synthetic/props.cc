// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/props.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "figure_cloth.h"
#include "figure_mesh.h"
#include "props_paint.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

constexpr uint64_t kPropPurpose = 0x70726F70;

Prop::Piece MakePiece(Mesh mesh, Material material) {
  return {std::make_shared<const Mesh>(std::move(mesh)), std::move(material)};
}

Material Painted(Picture picture) { return {std::move(picture)}; }
Material Plastic(float grey) { return {nullptr, Eigen::Vector3f::Constant(grey), 0.3f, 0, 0.5f}; }

}  // namespace

void Prop::AppendTo(const Rigid3d& world_from_prop, uint8_t label, std::vector<SceneObject>* objects) const {
  for (const Piece& piece : pieces) {
    objects->push_back({piece.mesh, piece.material, world_from_prop, label, false});
  }
}

Prop MakeCarton(uint64_t seed) {
  Rng rng(seed, 1, kPropPurpose);
  const Vector3d half(kCartonLength / 2, kCartonWidth / 2, 0);
  return {{MakePiece(BoxMesh(-half, half + Vector3d(0, 0, kCartonHeight)), Painted(PaintCarton(&rng)))}};
}

Prop MakeOfficeChair(uint64_t seed) {
  Rng rng(seed, 2, kPropPurpose);
  const Material cover = Painted(std::make_shared<const cv::Mat>(PaintCloth(Cloth::kChecks, &rng)));
  constexpr double kSeat = kChairSeatHeight;
  Mesh seat = Loft(
      std::vector<Section>{
          {kSeat - 0.06, 0.21, 0.22}, {kSeat - 0.03, 0.24, 0.25}, {kSeat - 0.012, 0.23, 0.24}},
      {32, 6, 4, 1, true, true});
  Displace(
      [](const Vertex& v) {
        return Vector3d(0, 0, std::min(0.0, kSeat - static_cast<double>(v.position.z())));
      },
      &seat);
  Mesh back = BoxMesh({-0.27, -0.21, kSeat + 0.10}, {-0.23, 0.21, kChairBackHeight});
  Mesh frame = Rod({0, 0, 0.10}, {0, 0, kSeat - 0.06}, 0.03);
  Append(Rod({-0.10, 0, kSeat - 0.07}, {-0.26, 0, kSeat - 0.02}, 0.02), &frame);
  Append(Rod({-0.26, 0, kSeat - 0.02}, {-0.255, 0, kSeat + 0.2}, 0.02), &frame);
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * std::numbers::pi * i / 5;
    const Vector3d tip(0.27 * std::cos(angle), 0.27 * std::sin(angle), 0.075);
    Append(Rod({0, 0, 0.11}, tip, 0.018), &frame);
    Append(Ellipsoid(tip - Vector3d(0, 0, 0.040), {0.035, 0.03, 0.035}), &frame);
  }
  return {{MakePiece(std::move(seat), cover), MakePiece(std::move(back), cover),
           MakePiece(std::move(frame), Plastic(0.12f))}};
}

Prop MakeSideTable(uint64_t seed) {
  Rng rng(seed, 3, kPropPurpose);
  Prop table;
  constexpr double kHalf = 0.26, kLeg = 0.23;
  table.pieces.push_back(
      MakePiece(BoxMesh({-kHalf, -kHalf, kTableHeight - 0.03}, {kHalf, kHalf, kTableHeight}),
                Painted(PaintWood(&rng))));
  Mesh legs;
  for (const double x : {-kLeg, kLeg}) {
    for (const double y : {-kLeg, kLeg}) {
      Append(BoxMesh({x - 0.02, y - 0.02, 0}, {x + 0.02, y + 0.02, kTableHeight - 0.03}), &legs);
    }
  }
  table.pieces.push_back(MakePiece(std::move(legs), Plastic(0.25f)));
  return table;
}

Prop MakeBoard(uint64_t seed) {
  Rng rng(seed, 4, kPropPurpose);
  const Vector3d half(kBoardThickness / 2, kBoardWidth / 2, kBoardHeight / 2);
  return {{MakePiece(BoxMesh(-half, half), Painted(PaintNotices(&rng)))}};
}

Prop MakeCabinet(uint64_t seed) {
  Rng rng(seed, 5, kPropPurpose);
  constexpr double x = kCabinetDepth / 2, y = kCabinetWidth / 2, z = kCabinetHeight, t = 0.02;
  Mesh body = BoxMesh({-x, -y, 0}, {x, -y + t, z});
  Append(BoxMesh({-x, y - t, 0}, {x, y, z}), &body);
  Append(BoxMesh({-x, -y, z - t}, {x, y, z}), &body);
  Append(BoxMesh({-x, -y, 0}, {x, y, 0.06}), &body);
  Append(BoxMesh({-x, -y, 0}, {-x + t, y, z}), &body);
  Mesh files;
  for (const double shelf : {0.40, 0.75, 1.10}) {
    Append(BoxMesh({-x, -y, shelf - 0.01}, {x - 0.03, y, shelf + 0.01}), &body);
    Append(BoxMesh({-x + t, -y + t, shelf + 0.01}, {x - 0.07, y - 0.1, shelf + 0.25}), &files);
  }
  return {{MakePiece(std::move(body), Painted(PaintWood(&rng))),
           MakePiece(std::move(files), Painted(PaintFiles(&rng)))}};
}

Prop MakeCabinetDoor(uint64_t seed, bool mirrored) {
  Rng rng(seed, 6, kPropPurpose);
  constexpr double kFreeEdge = -kCabinetWidth + 0.06;
  Mesh leaf = BoxMesh({0, -kCabinetWidth, 0.02}, {0.02, 0, kCabinetHeight});
  Mesh handle = Rod({0.05, kFreeEdge, 0.75}, {0.05, kFreeEdge, 0.90}, 0.01);
  if (mirrored) {
    MirrorY(&leaf);
    MirrorY(&handle);
  }
  return {
      {MakePiece(std::move(leaf), Painted(PaintNotices(&rng))), MakePiece(std::move(handle), Plastic(0.6f))}};
}

}  // namespace orbslam
