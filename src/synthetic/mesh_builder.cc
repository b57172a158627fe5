// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbslam {

using Eigen::Vector2d;
using Eigen::Vector3d;

void MeshBuilder::JoinGrid(uint32_t first, uint32_t rows, uint32_t columns) {
  for (uint32_t row = 0; row + 1 < rows; ++row) {
    for (uint32_t column = 0; column + 1 < columns; ++column) {
      const uint32_t a = first + row * columns + column, b = a + columns;  // b is below a
      for (const uint32_t index : {a, b, b + 1, a, b + 1, a + 1}) mesh_.indices.push_back(index);
    }
  }
}

void MeshBuilder::AddQuad(const Vector3d& top_left, const Vector3d& right, const Vector3d& down,
                          const UvRect& uv, double max_piece) {
  const auto first = static_cast<uint32_t>(mesh_.vertices.size());
  const auto pieces = [&](double length) {
    return static_cast<int>(std::max(1.0, std::ceil(length / max_piece)));
  };
  const int columns = pieces(right.norm()), rows = pieces(down.norm());
  const Eigen::Vector3f normal = down.cross(right).normalized().cast<float>();
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const Vector2d share(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
      const Vector3d position = top_left + share.x() * right + share.y() * down;
      const Vector2d texel = uv.corner + share.cwiseProduct(uv.size);
      mesh_.vertices.push_back({position.cast<float>(), normal, texel.cast<float>()});
    }
  }
  JoinGrid(first, rows + 1, columns + 1);
}

void MeshBuilder::AddLathe(const Eigen::Isometry3d& mesh_from_local, std::span<const Vector2d> profile,
                           int num_sides) {
  const auto first = static_cast<uint32_t>(mesh_.vertices.size());
  const auto last = static_cast<int>(profile.size()) - 1;
  for (int i = last; i >= 0; --i) {
    const Vector2d along = profile[std::min(i + 1, last)] - profile[std::max(i - 1, 0)];
    const Vector2d outwards = Vector2d(along.y(), -along.x()).normalized();  // (radial, z)
    for (int side = 0; side <= num_sides; ++side) {
      const double share = static_cast<double>(side) / num_sides, angle = 2 * std::numbers::pi * share;
      const Vector3d radial(std::cos(angle), std::sin(angle), 0);
      const Vector3d position = profile[i].x() * radial + profile[i].y() * Vector3d::UnitZ();
      const Vector3d normal = outwards.x() * radial + outwards.y() * Vector3d::UnitZ();
      const Vector2d texel(share, static_cast<double>(last - i) / last);
      mesh_.vertices.push_back({(mesh_from_local * position).cast<float>(),
                                (mesh_from_local.linear() * normal).cast<float>(), texel.cast<float>()});
    }
  }
  JoinGrid(first, last + 1, num_sides + 1);
}

void MeshBuilder::AddTube(std::span<const Vector3d> path, double radius, int num_sides) {
  const auto first = static_cast<uint32_t>(mesh_.vertices.size());
  const size_t last = path.size() - 1;
  double length = 0;
  for (size_t i = 0; i <= last; ++i) {
    const size_t k = last - i;  // the lathe's order: the end comes first
    const Vector3d along = (path[std::min(k + 1, last)] - path[k > 0 ? k - 1 : 0]).normalized();
    const Vector3d x = along.unitOrthogonal(), y = along.cross(x);
    if (i > 0) length += (path[k + 1] - path[k]).norm();
    for (int side = 0; side <= num_sides; ++side) {
      const double share = static_cast<double>(side) / num_sides, angle = 2 * std::numbers::pi * share;
      const Vector3d normal = std::cos(angle) * x + std::sin(angle) * y;
      mesh_.vertices.push_back({(path[k] + radius * normal).cast<float>(), normal.cast<float>(),
                                Vector2d(share, length).cast<float>()});
    }
  }
  JoinGrid(first, static_cast<uint32_t>(last + 1), num_sides + 1);
}

}  // namespace orbslam
