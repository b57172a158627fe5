// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/render/scene.h"

namespace orbslam {

/// A rigid thing of several surfaces.
struct Prop {
  struct Piece {
    std::shared_ptr<const Mesh> mesh;
    Material material;
  };
  std::vector<Piece> pieces;

  void AppendTo(const Rigid3d& world_from_prop, uint8_t label, std::vector<SceneObject>* objects) const;
};

/// Sizes in metres. Frames have z up; of what stands on the floor (or, the carton, on its bottom) the origin
/// is below its middle, and x is its front.
inline constexpr double kCartonLength = 0.30, kCartonWidth = 0.42, kCartonHeight = 0.28;
inline constexpr double kChairSeatHeight = 0.46, kChairBackHeight = 0.92;
inline constexpr double kTableHeight = 0.72;
inline constexpr double kBoardWidth = 1.30, kBoardHeight = 1.15, kBoardThickness = 0.02;
inline constexpr double kCabinetWidth = 0.62, kCabinetDepth = 0.34, kCabinetHeight = 1.45;

Prop MakeCarton(uint64_t seed);
Prop MakeOfficeChair(uint64_t seed);
Prop MakeSideTable(uint64_t seed);
/// A pin board with papers on its front and its back; the origin in its middle.
Prop MakeBoard(uint64_t seed);
/// A cupboard without its door.
Prop MakeCabinet(uint64_t seed);
/// Its door: the origin at the foot of the hinge; closed it goes from there along -y (mirrored: +y), its
/// front towards x.
Prop MakeCabinetDoor(uint64_t seed, bool mirrored);

}  // namespace orbslam
