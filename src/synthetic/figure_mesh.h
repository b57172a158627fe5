// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <span>

#include "orbslam/render/scene.h"

namespace orbslam {

/// A cross-section of a body at height z: an ellipse round (center_x, center_y), metres.
struct Section {
  double z, radius_x, radius_y, center_x = 0, center_y = 0;
};

/// How a loft is cut into triangles and what its texture coordinates are: repeats_u times round it (0 at the
/// back, u grows to the left, the front in the middle), repeats_v times from the top down.
struct LoftDetail {
  int around = 24, along = 16;
  double repeats_u = 1, repeats_v = 1;
  bool close_bottom = true, close_top = true;  // by rounded ends beyond the last sections
};

/// A smooth skin over sections that rise in z: cubic between them. At least two sections.
Mesh Loft(std::span<const Section> sections, const LoftDetail& detail);

Mesh Ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii, int around = 16, int along = 10);

/// A box by its corners; each side shows the texture once, upright on the four walls.
Mesh BoxMesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// A round bar.
Mesh Rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, int around = 12);

/// Moves every vertex and computes the normals anew; vertices at one place stay together.
void Displace(const std::function<Eigen::Vector3d(const Vertex&)>& offset, Mesh* mesh);
void Transform(const Eigen::Isometry3d& to_from_mesh, Mesh* mesh);
/// Mirrors left and right (y), with the triangles turned round.
void MirrorY(Mesh* mesh);
void Append(const Mesh& other, Mesh* mesh);

}  // namespace orbslam
