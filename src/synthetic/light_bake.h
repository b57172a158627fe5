// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "orbslam/render/renderer.h"

namespace orbslam {

/// An upright box that keeps light away: turned about the vertical. World, metres.
struct Occluder {
  Eigen::Vector3d middle, half_size;
  double cosine = 1, sine = 0;  // of its yaw
};

/// Sets the vertices' share of light: from lamps of half a metre's extent and from the hemisphere, as far as
/// occluders nearer than a metre or so hide it. The mesh is in the world frame.
void BakeLight(std::span<const Occluder> occluders, const Lighting& lighting, Mesh* mesh);

}  // namespace orbslam
