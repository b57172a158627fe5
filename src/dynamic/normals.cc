// SPDX-License-Identifier: GPL-3.0-or-later
#include "normals.h"

#include <cmath>

#include "wide_vectors.h"

namespace orbslam {
namespace {

constexpr int kReach = 2;  // cells; the Kinect's noise is correlated over less

/// Without branches, so that the compiler vectorises it.
void ComputeRows(const GridCamera& camera, WorkingFrame* frame) {
  const cv::Mat1f& depth = frame->depth_m;
  const float inverse_fx = 1 / camera.fx, inverse_fy = 1 / camera.fy, fx = camera.fx, fy = camera.fy;
  const float cx = camera.cx;
  for (int v = kReach; v < depth.rows - kReach; ++v) {
    const float *row = depth[v], *up = depth[v - kReach], *down = depth[v + kReach];
    float *__restrict normal_x = frame->normal_x[v], *__restrict normal_y = frame->normal_y[v],
                     *__restrict normal_z = frame->normal_z[v];
    const float b = (static_cast<float>(v) - camera.cy) * inverse_fy;
    for (int u = kReach; u < depth.cols - kReach; ++u) {
      const float z = row[u], left = row[u - kReach], right = row[u + kReach], above = up[u], below = down[u];
      const float step = kReach * MaxSurfaceStepM(z);
      const bool is_surface = (z > 0) & (left > 0) & (right > 0) & (above > 0) & (below > 0) &
                              (std::abs(left - z) <= step) & (std::abs(right - z) <= step) &
                              (std::abs(above - z) <= step) & (std::abs(below - z) <= step);
      // With x = a z, y = b z: P_u x P_v is along (-z_u fx, -z_v fy, z + a fx z_u + b fy z_v), up to sign.
      const float slope_u = (right - left) / (2 * kReach), slope_v = (below - above) / (2 * kReach);
      const float a = (static_cast<float>(u) - cx) * inverse_fx;
      const float nx = slope_u * fx, ny = slope_v * fy, nz = -(z + a * nx + b * ny);
      const float scale = 1 / std::sqrt(nx * nx + ny * ny + nz * nz);
      normal_x[u] = is_surface ? nx * scale : 0.f;
      normal_y[u] = is_surface ? ny * scale : 0.f;
      normal_z[u] = is_surface ? nz * scale : 0.f;
    }
  }
}

ORBSLAM_WIDE_VECTORS void ComputeRowsWide(const GridCamera& camera, WorkingFrame* frame) {
  ComputeRows(camera, frame);
}

}  // namespace

void ComputeNormals(const GridCamera& camera, WorkingFrame* frame) {
  for (cv::Mat1f* image : {&frame->normal_x, &frame->normal_y, &frame->normal_z})
    *image = cv::Mat1f::zeros(frame->depth_m.size());
  (HasWideVectors() ? ComputeRowsWide : ComputeRows)(camera, frame);
}

}  // namespace orbslam
