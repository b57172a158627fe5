// SPDX-License-Identifier: GPL-3.0-or-later
#include "normals.h"

#include <cmath>

namespace orbslam {
namespace {

constexpr int kReach = 2;  // cells; the Kinect's noise is correlated over less

}  // namespace

void ComputeNormals(const GridCamera& camera, WorkingFrame* frame) {
  const cv::Mat1f& depth = frame->depth_m;
  for (cv::Mat1f* image : {&frame->normal_x, &frame->normal_y, &frame->normal_z})
    *image = cv::Mat1f::zeros(depth.size());
  const float inverse_fx = 1 / camera.fx, inverse_fy = 1 / camera.fy;
  for (int v = kReach; v < depth.rows - kReach; ++v) {
    const float *row = depth[v], *up = depth[v - kReach], *down = depth[v + kReach];
    for (int u = kReach; u < depth.cols - kReach; ++u) {
      const float z = row[u], left = row[u - kReach], right = row[u + kReach], above = up[u], below = down[u];
      if (!(z > 0 && left > 0 && right > 0 && above > 0 && below > 0)) continue;
      const float step = kReach * MaxSurfaceStepM(z);
      if (std::abs(left - z) > step || std::abs(right - z) > step || std::abs(above - z) > step ||
          std::abs(below - z) > step)
        continue;
      // With x = a z, y = b z: P_u x P_v is along (-z_u fx, -z_v fy, z + a fx z_u + b fy z_v), up to sign.
      const float slope_u = (right - left) / (2 * kReach), slope_v = (below - above) / (2 * kReach);
      const float a = (static_cast<float>(u) - camera.cx) * inverse_fx;
      const float b = (static_cast<float>(v) - camera.cy) * inverse_fy;
      const float nx = slope_u * camera.fx, ny = slope_v * camera.fy, nz = -(z + a * nx + b * ny);
      const float scale = 1 / std::sqrt(nx * nx + ny * ny + nz * nz);
      frame->normal_x(v, u) = nx * scale;
      frame->normal_y(v, u) = ny * scale;
      frame->normal_z(v, u) = nz * scale;
    }
  }
}

}  // namespace orbslam
