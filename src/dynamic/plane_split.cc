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

bool IsOn(const Plane& plane, float ray_x, float ray_y, float depth_m, float noise_m) {
  const float slope = plane.normal.dot(Eigen::Vector3f(ray_x, ray_y, 1.f));
  return (std::abs(slope) >= kMinRayCos) &
         (std::abs(slope * depth_m - plane.distance_m) < noise_m * std::abs(slope) + kFlatM);
}

/// Cells of a cluster, spread evenly; structure of arrays, for vectors.
struct Sample {
  std::vector<float> ray_x, ray_y, depth_m, noise_m;

  int NumOn(const Plane& plane) const {
    int count = 0;
    for (size_t k = 0; k < depth_m.size(); ++k)
      count += IsOn(plane, ray_x[k], ray_y[k], depth_m[k], noise_m[k]);
    return count;
  }
};

class ClusterPlanes {
 public:
  ClusterPlanes(const GridCamera& camera, const WorkingFrame& frame) : camera_(camera), frame_(frame) {}

  /// The cells on the plane that holds most of them; empty if that is smaller than min_area_m2.
  std::vector<int> Largest(const std::vector<int>& cells, float min_area_m2) const {
    const Sample sample = SampleOf(cells);
    Plane best{Eigen::Vector3f::Zero(), 0.f};
    int most = 0;
    for (int i = 0; i < kCandidates; ++i) {
      const int cell = cells[cells.size() * i / kCandidates];
      const Plane plane{Normal(cell), Normal(cell).dot(Ray(cell)) * frame_.depth_m(cell)};
      const int count = sample.NumOn(plane);
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

  Sample SampleOf(const std::vector<int>& cells) const {
    Sample sample;
    const size_t step = std::max<size_t>(1, cells.size() / kCountedCells);
    for (size_t k = 0; k < cells.size(); k += step) {
      const Eigen::Vector3f ray = Ray(cells[k]);
      const float z = frame_.depth_m(cells[k]);
      sample.ray_x.push_back(ray.x()), sample.ray_y.push_back(ray.y());
      sample.depth_m.push_back(z), sample.noise_m.push_back(kGateSigma * DepthSigmaM(z));
    }
    return sample;
  }

  bool IsOn(int cell, const Plane& plane) const {
    const Eigen::Vector3f ray = Ray(cell);
    const float z = frame_.depth_m(cell);
    return orbslam::IsOn(plane, ray.x(), ray.y(), z, kGateSigma * DepthSigmaM(z));
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
