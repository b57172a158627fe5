// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "orbslam/synthetic/texture.h"

namespace orbslam {

/// A one-sided textured rectangle: origin + u edge_u + v edge_v with u, v in [0, 1]; from the front the
/// texture's x runs along edge_u, its y along edge_v. World frame: z up, metres.
struct Surface {
  Eigen::Vector3d origin, edge_u, edge_v;
  Texture texture;
};

/// A closed room of 6 x 5 x 2.7 m, the middle of its floor at the origin, furnished along the walls with
/// desks, shelves, cupboards, monitors and cartons: always the same furniture, painted from the seed. Free
/// for cameras: |x| < 1.7 m, |y| < 1.3 m, z from 0.8 to 2.2 m. texels_per_metre: positive; time and memory
/// grow with its square.
std::vector<Surface> MakeRoom(uint64_t seed, double texels_per_metre);

}  // namespace orbslam
