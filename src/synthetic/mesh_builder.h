// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "orbslam/render/scene.h"

namespace orbslam {

/// Part of a texture: its corner and its size, in fractions of the texture (more than 1 repeats it).
struct UvRect {
  Eigen::Vector2d corner{0, 0}, size{1, 1};
};

/// Puts a mesh together from pieces, all given in the frame of the mesh, metres.
class MeshBuilder {
 public:
  /// A parallelogram seen from its front: from the top left corner `right` runs right and `down` down, as
  /// does the texture. Cut into pieces of at most max_piece, so that light can vary over it.
  void AddQuad(const Eigen::Vector3d& top_left, const Eigen::Vector3d& right, const Eigen::Vector3d& down,
               const UvRect& uv, double max_piece = 1e9);
  /// A surface of revolution about the axis z of `mesh_from_local`: profile of (radius, z) from bottom to
  /// top, smooth between consecutive points. u runs round, v down.
  void AddLathe(const Eigen::Isometry3d& mesh_from_local, std::span<const Eigen::Vector2d> profile,
                int num_sides);
  /// A tube of constant radius along a polyline.
  void AddTube(std::span<const Eigen::Vector3d> path, double radius, int num_sides);

  bool empty() const { return mesh_.indices.empty(); }
  Mesh& mesh() { return mesh_; }

 private:
  /// Joins a grid of rows x columns vertices, just added, by triangles.
  void JoinGrid(uint32_t first, uint32_t rows, uint32_t columns);

  Mesh mesh_;
};

}  // namespace orbslam
