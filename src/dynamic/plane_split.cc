// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_split.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "depth_noise.h"

namespace orbslam {
namespace {

constexpr int kCandidates = 32, kCountedCells = 400;  // of a cluster, spread evenly
constexpr float kGateSigma = 3.f, kFlatM = 0.01f;  // off a plane: the sensor's noise, and the floor's waves
constexpr float kMinRayCos = 0.05f;                // more oblique, nothing is measured

struct Plane {
  Eigen::Vector3f normal;
  float distance_m;
};

class ClusterPlanes {
 public:
  ClusterPlanes(const GridCamera& camera, const WorkingFrame& frame) : camera_(camera), frame_(frame) {}

  /// The cells on the plane that holds most of them; empty if that is smaller than min_area_m2.
  std::vector<int> Largest(const std::vector<int>& cells, float min_area_m2) const {
    const size_t step = std::max<size_t>(1, cells.size() / kCountedCells);
    Plane best{Eigen::Vector3f::Zero(), 0.f};
    int most = 0;
    for (int i = 0; i < kCandidates; ++i) {
      const int cell = cells[cells.size() * i / kCandidates];
      const Plane plane{Normal(cell), Normal(cell).dot(Ray(cell)) * frame_.depth_m(cell)};
      int count = 0;
      for (size_t k = 0; k < cells.size(); k += step) count += IsOn(cells[k], plane);
      if (count > most) most = count, best = plane;
    }
    std::vector<int> on_plane;
    float area_m2 = 0;
    for (const int cell : cells) {
      if (most == 0 || !IsOn(cell, best)) continue;
      on_plane.push_back(cell);
      area_m2 += AreaM2(cell, best);
    }
    return area_m2 >= min_area_m2 ? on_plane : std::vector<int>();
  }

 private:
  /// With z = 1.
  Eigen::Vector3f Ray(int cell) const {
    const int u = cell % camera_.width, v = cell / camera_.width;
    return {(static_cast<float>(u) - camera_.cx) / camera_.fx,
            (static_cast<float>(v) - camera_.cy) / camera_.fy, 1.f};
  }

  Eigen::Vector3f Normal(int cell) const {
    return {frame_.normal_x(cell), frame_.normal_y(cell), frame_.normal_z(cell)};
  }

  bool IsOn(int cell, const Plane& plane) const {
    const float z = frame_.depth_m(cell), slope = plane.normal.dot(Ray(cell));
    if (std::abs(slope) < kMinRayCos) return false;
    return std::abs(slope * z - plane.distance_m) < kGateSigma * DepthSigmaM(z) * std::abs(slope) + kFlatM;
  }

  float AreaM2(int cell, const Plane& plane) const {
    const float z = frame_.depth_m(cell);
    return z * z / (camera_.fx * camera_.fy * std::max(kMinRayCos, std::abs(plane.normal.dot(Ray(cell)))));
  }

  const GridCamera& camera_;
  const WorkingFrame& frame_;
};

}  // namespace

std::vector<Cluster> TakePlanes(const GridCamera& camera, const WorkingFrame& frame,
                                std::span<const Cluster> clusters, float min_area_m2, cv::Mat1b* included) {
  const ClusterPlanes planes(camera, frame);
  std::vector<Cluster> flat;
  for (const Cluster& cluster : clusters) {
    std::vector<int> cells = planes.Largest(cluster.cells, min_area_m2);
    if (cells.empty()) continue;
    for (const int cell : cells) (*included)(cell) = 0;
    flat.push_back({std::move(cells), true});
  }
  return flat;
}

Segmentation SegmentSurfaces(const GridCamera& camera, const WorkingFrame& frame, const cv::Mat1b& included,
                             const SegmentationOptions& options) {
  Segmentation joined = SegmentCells(frame.depth_m, included, options.min_cells);
  if (!options.use_planes) return joined;
  cv::Mat1b rest = included.clone();
  std::vector<Cluster> flat = TakePlanes(camera, frame, joined.clusters, options.min_plane_m2, &rest);
  if (flat.empty()) return joined;
  Segmentation result = SegmentCells(frame.depth_m, rest, options.min_cells);
  for (Cluster& cluster : flat) {
    for (const int cell : cluster.cells) result.labels(cell) = static_cast<int>(result.clusters.size());
    result.clusters.push_back(std::move(cluster));
  }
  return result;
}

}  // namespace orbslam
