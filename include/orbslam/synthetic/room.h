// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "orbslam/render/renderer.h"
#include "orbslam/render/scene.h"

namespace orbslam {

struct Room {
  std::vector<SceneObject> objects;  // label 0, meshes in the world frame, light baked in
  Lighting lighting;                 // that the light was baked for
};

/// An office of 6 x 5 x 2.7 m, the middle of its floor at the origin, z up: desks with monitors and clutter
/// along the walls (the main one along +y), shelves with books, posters, a window, a door. Furniture always
/// stands where it does; colours, pictures, papers and other clutter vary with the seed. Free for people and
/// cameras: |x| < 1.9 m, |y| < 1.4 m. texels_per_metre: of the walls; what lies on desks has more.
Room MakeRoom(uint64_t seed, double texels_per_metre);

}  // namespace orbslam
