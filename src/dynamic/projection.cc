// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection.h"

#include <algorithm>

#include "wide_vectors.h"

namespace orbslam {
namespace {

void ProjectCells(GridCamera camera, const Rigid3d& other_from_this, int v, const float* depth_m,
                  ProjectedRow* row) {
  const Eigen::Matrix3f r = other_from_this.RotationMatrix().cast<float>();
  const Eigen::Vector3f t = other_from_this.translation.cast<float>();
  const float b = (static_cast<float>(v) - camera.cy) / camera.fy, inverse_fx = 1 / camera.fx;
  // A ray's direction in the other view is linear in u.
  const Eigen::Vector3f first = r * Eigen::Vector3f(-camera.cx * inverse_fx, b, 1),
                        step = r.col(0) * inverse_fx;
  constexpr float kNearestM = 0.1f;
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  int* index = row->index.data();
  float* out = row->depth_m.data();
  for (int u = 0; u < camera.width; ++u) {  // without branches, so that the compiler vectorises it
    const float z = depth_m[u], n = static_cast<float>(u);
    const float qz = (first.z() + n * step.z()) * z + t.z();
    const float inverse = 1 / std::max(qz, kNearestM);
    const float pu = ((first.x() + n * step.x()) * z + t.x()) * inverse * camera.fx + camera.cx + 0.5f;
    const float pv = ((first.y() + n * step.y()) * z + t.y()) * inverse * camera.fy + camera.cy + 0.5f;
    const float column = std::min(std::max(pu, 0.f), width), line = std::min(std::max(pv, 0.f), height);
    const bool inside =
        (z > 0) & (qz > kNearestM) & (column == pu) & (line == pv) & (pu != width) & (pv != height);
    const int at = static_cast<int>(line) * camera.width + static_cast<int>(column);
    out[u] = inside ? qz : kNowhereM;
    index[u] = inside ? at : 0;
  }
}

ORBSLAM_WIDE_VECTORS void ProjectCellsWide(GridCamera camera, const Rigid3d& other_from_this, int v,
                                           const float* depth_m, ProjectedRow* row) {
  ProjectCells(camera, other_from_this, v, depth_m, row);
}

}  // namespace

void ProjectRow(GridCamera camera, const Rigid3d& other_from_this, int v, const float* depth_m,
                ProjectedRow* row) {
  (HasWideVectors() ? ProjectCellsWide : ProjectCells)(camera, other_from_this, v, depth_m, row);
}

}  // namespace orbslam
