// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/ray_caster.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

/// One surface from one camera: (u, v, 1) / depth = plane_from_pixel * (x, y, 1).
struct Projection {
  Eigen::Matrix3d plane_from_pixel;
  const Texture* texture;
  // Inverse depth below which mip level i + 1 is the better one.
  std::array<float, Texture::kNumLevels - 1> level_limits;
};

std::vector<Projection> ProjectFrontFaces(std::span<const Surface> surfaces, const PinholeCamera& camera,
                                          const Rigid3d& camera_from_world) {
  Eigen::Matrix3d intrinsics;
  intrinsics << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  const Eigen::Matrix3d rotation = camera_from_world.RotationMatrix();
  std::vector<Projection> projections;
  for (const Surface& surface : surfaces) {
    Eigen::Matrix3d camera_from_plane;
    camera_from_plane << rotation * surface.edge_u, rotation * surface.edge_v,
        camera_from_world * surface.origin;
    constexpr double kEdgeOn = 1e-9;  // cubic metres: six times the volume of the pyramid under the camera
    if (camera_from_plane.determinant() < kEdgeOn) continue;
    Projection projection{(intrinsics * camera_from_plane).inverse(), &surface.texture, {}};
    // A pixel covers |det H| / inverse_depth^3 of the plane's (u, v), and level i has a texel for 4^i of
    // level 0's. A ray stands for a quarter of a pixel; the boundary between levels is at their geometric
    // mean.
    const double texels =
        projection.plane_from_pixel.determinant() * surface.texture.width() * surface.texture.height() / 4.0;
    for (int i = 0; i + 1 < Texture::kNumLevels; ++i) {
      projection.level_limits[i] = static_cast<float>(std::cbrt(texels / std::pow(4.0, i + 0.5)));
    }
    projections.push_back(projection);
  }
  return projections;
}

/// The integers x in [first, last] with offset + x * slope >= 0 for every constraint added.
struct RowInterval {
  double first, last;

  void Require(double slope, double offset) {
    if (slope > 0) {
      first = std::max(first, std::ceil(-offset / slope));
    } else if (slope < 0) {
      last = std::min(last, std::floor(-offset / slope));
    } else if (offset < 0) {
      last = -1;
    }
  }
};

/// The rays of one row of pixels, all displaced by the same fraction of a pixel.
class RowCaster {
 public:
  RowCaster(std::span<const Projection> projections, int width)
      : projections_(projections), inverse_depth_(width), hit_(width), sum_even_(width), sum_odd_(width) {}

  /// Finds the nearest surface at (x + dx, y) for every integer x.
  void Cast(double dx, double y) {
    std::fill(inverse_depth_.begin(), inverse_depth_.end(), 0.0f);
    std::fill(hit_.begin(), hit_.end(), kNothing);
    dx_ = dx;
    y_ = y;
    for (size_t i = 0; i < projections_.size(); ++i) Cover(static_cast<uint16_t>(i));
  }

  void WriteDepth(float* depth_m) const {
    for (size_t x = 0; x < hit_.size(); ++x)
      depth_m[x] = hit_[x] == kNothing ? 0.0f : 1.0f / inverse_depth_[x];
  }

  /// Adds the colours of the rays cast last. level_bias in octaves of inverse depth: rays of one pixel look
  /// up different mip levels near a boundary, which blends it.
  void AddColors(float level_bias) {
    for (size_t x = 0; x < hit_.size();) {
      const uint16_t id = hit_[x];
      size_t end = x + 1;
      while (end < hit_.size() && hit_[end] == id) ++end;
      if (id != kNothing) AddSpan(projections_[id], x, end, level_bias);
      x = end;
    }
  }

  /// The mean of four rays a pixel; starts the next sum.
  void TakeColors(cv::Vec3b* bgr) {
    for (size_t x = 0; x < hit_.size(); ++x) {
      const uint32_t even = (sum_even_[x] + 0x00020002) >> 2, odd = (sum_odd_[x] + 0x00020002) >> 2;
      bgr[x] = {static_cast<uint8_t>(even), static_cast<uint8_t>(odd), static_cast<uint8_t>(even >> 16)};
      sum_even_[x] = sum_odd_[x] = 0;
    }
  }

 private:
  static constexpr uint16_t kNothing = std::numeric_limits<uint16_t>::max();

  Eigen::Vector3d RowOffset(const Eigen::Matrix3d& h) const { return h * Eigen::Vector3d(dx_, y_, 1.0); }

  void Cover(uint16_t id) {
    constexpr double kOverlap = 1e-6;     // closes the seams between neighbouring rectangles
    constexpr double kMinInverse = 1e-3;  // 1 / m: behind and beside the camera it is negative
    const Eigen::Matrix3d& h = projections_[id].plane_from_pixel;
    const Eigen::Vector3d slope = h.col(0), offset = RowOffset(h);
    RowInterval row{0.0, static_cast<double>(hit_.size()) - 1.0};
    row.Require(slope[2], offset[2] - kMinInverse);
    for (const int i : {0, 1}) {
      row.Require(slope[i] + kOverlap * slope[2], offset[i] + kOverlap * offset[2]);
      row.Require((1 + kOverlap) * slope[2] - slope[i], (1 + kOverlap) * offset[2] - offset[i]);
    }
    if (row.first > row.last) return;  // before the cast: a bound can be beyond all integers
    const auto slope_z = static_cast<float>(slope[2]), offset_z = static_cast<float>(offset[2]);
    for (int x = static_cast<int>(row.first); x <= static_cast<int>(row.last); ++x) {
      const float inverse_depth = offset_z + static_cast<float>(x) * slope_z;
      const bool nearer = inverse_depth > inverse_depth_[x];
      inverse_depth_[x] = nearer ? inverse_depth : inverse_depth_[x];
      hit_[x] = nearer ? id : hit_[x];
    }
  }

  void AddSpan(const Projection& projection, size_t begin, size_t end, float level_bias) {
    const Eigen::Vector3f slope = projection.plane_from_pixel.col(0).cast<float>();
    const Eigen::Vector3f offset = RowOffset(projection.plane_from_pixel).cast<float>();
    for (size_t x = begin; x < end; ++x) {
      const float depth = 1.0f / inverse_depth_[x], column = static_cast<float>(x);
      int level = 0;
      for (const float limit : projection.level_limits) level += inverse_depth_[x] * level_bias < limit;
      const uint32_t color = projection.texture->Sample((offset[0] + column * slope[0]) * depth,
                                                        (offset[1] + column * slope[1]) * depth, level);
      sum_even_[x] += color & 0x00FF00FF;
      sum_odd_[x] += color >> 8 & 0x00FF00FF;
    }
  }

  std::span<const Projection> projections_;
  double dx_ = 0, y_ = 0;  // px
  std::vector<float> inverse_depth_;
  std::vector<uint16_t> hit_;
  std::vector<uint32_t> sum_even_, sum_odd_;  // blue and red, green: two 16-bit lanes each
};

void CastRows(std::span<const Projection> projections, int first_row, int end_row, View* view) {
  RowCaster caster(projections, view->bgr.cols);
  for (int y = first_row; y < end_row; ++y) {
    caster.Cast(0.0, y);
    caster.WriteDepth(view->depth_m.ptr<float>(y));
    float level_bias = 0.8f;
    for (const double dy : {-0.25, 0.25}) {
      for (const double dx : {-0.25, 0.25}) {
        caster.Cast(dx, y + dy);
        caster.AddColors(level_bias);
        level_bias *= 1.17f;
      }
    }
    caster.TakeColors(view->bgr.ptr<cv::Vec3b>(y));
  }
}

}  // namespace

View CastRays(std::span<const Surface> surfaces, const PinholeCamera& camera,
              const Rigid3d& world_from_camera, int num_threads) {
  ORBSLAM_CHECK(num_threads >= 1 && !camera.IsDistorted());
  View view{cv::Mat(camera.height, camera.width, CV_8UC3), cv::Mat(camera.height, camera.width, CV_32FC1)};
  const auto projections = ProjectFrontFaces(surfaces, camera, Inverse(world_from_camera));
  std::vector<std::jthread> threads;
  for (int i = 0; i < num_threads; ++i) {
    const int first_row = camera.height * i / num_threads, end_row = camera.height * (i + 1) / num_threads;
    threads.emplace_back([=, &projections, &view] { CastRows(projections, first_row, end_row, &view); });
  }
  threads.clear();  // joins
  return view;
}

}  // namespace orbslam
