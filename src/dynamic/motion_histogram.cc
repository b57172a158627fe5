// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/motion_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "orbslam/camera/depth_model.h"
#include "orbslam/util/check.h"
#include "wide_vectors.h"

namespace orbslam {
namespace {

constexpr float kMinBinM = 0.02F;

/// A capsule in one cloud's frame: the points within radius of a segment of 2 reach round the centre.
struct Capsule {
  Eigen::Vector3f centre;
  Eigen::Vector3f direction;
  float reach;
  float radius;
};

Capsule InFrameOf(const HistogramRow& row, const SweptVolume& volume, float reach_m) {
  const Rigid3d cloud_from_current = Inverse(row.current_from_cloud);
  return {(cloud_from_current * volume.ball.centre_m.cast<double>()).cast<float>(),
          (cloud_from_current.rotation * volume.direction.cast<double>()).cast<float>(), reach_m,
          volume.ball.radius_m};
}

/// Adds `weight` at `position`, in bins from the centre of the first one; inside but for rounding.
void Splat(float position, float weight, int num_bins, float* bins) {
  const int low = std::clamp(static_cast<int>(position), 0, num_bins - 2);
  const float share = weight * (position - static_cast<float>(low));
  bins[low] += weight - share;
  bins[low + 1] += share;
}

/// Where one of a block's points, or the centre of a sphere, is along the capsule, and how far from its axis.
struct Placement {
  float along, squared_distance;

  Placement(float x_m, float y_m, float z_m, const Capsule& capsule) {
    const float x = x_m - capsule.centre.x(), y = y_m - capsule.centre.y(), z = z_m - capsule.centre.z();
    along = x * capsule.direction.x() + y * capsule.direction.y() + z * capsule.direction.z();
    const float nearest = std::min(std::max(along, -capsule.reach), capsule.reach);
    squared_distance = x * x + y * y + z * z + nearest * (nearest - 2 * along);
  }
};

/// Blocks that may have points in the capsule. Without branches, so that the compiler vectorises it.
void FindNear(const HistogramCloud::Spheres& spheres, const Capsule& capsule, std::vector<uint8_t>* is_near) {
  const size_t count = spheres.x_m.size();
  const float *x_m = spheres.x_m.data(), *y_m = spheres.y_m.data(), *z_m = spheres.z_m.data(),
              *radius_m = spheres.radius_m.data();
  is_near->resize(count);
  uint8_t* out = is_near->data();
  for (size_t b = 0; b < count; ++b) {
    const float limit = capsule.radius + radius_m[b];
    out[b] = Placement(x_m[b], y_m[b], z_m[b], capsule).squared_distance <= limit * limit;
  }
}

void FillRow(const HistogramCloud& cloud, const Capsule& capsule, float first_m, float bin_m, int num_bins,
             float* bins) {
  constexpr int kSize = HistogramCloud::Block::kSize;
  const float squared_radius = capsule.radius * capsule.radius;
  const float per_bin = 1.0F / bin_m;
  std::vector<uint8_t> is_near;
  FindNear(cloud.spheres(), capsule, &is_near);
  for (size_t b = 0; b < is_near.size(); ++b) {
    if (is_near[b] == 0) continue;
    const HistogramCloud::Block& block = cloud.blocks()[b];
    std::array<float, kSize> along, squared_distance;
    for (int i = 0; i < kSize; ++i) {
      const Placement point(block.x_m[i], block.y_m[i], block.z_m[i], capsule);
      along[i] = point.along, squared_distance[i] = point.squared_distance;
    }
    for (int i = 0; i < kSize; ++i) {
      if (squared_distance[i] > squared_radius) continue;
      Splat((along[i] - first_m) * per_bin, block.weight[i], num_bins, bins);
    }
  }
}

ORBSLAM_WIDE_VECTORS void FillRowWide(const HistogramCloud& cloud, const Capsule& capsule, float first_m,
                                      float bin_m, int num_bins, float* bins) {
  FillRow(cloud, capsule, first_m, bin_m, num_bins, bins);
}

void Append(const Eigen::Vector3f& point_m, float weight, int index, HistogramCloud::Block* block) {
  block->x_m[index] = point_m.x();
  block->y_m[index] = point_m.y();
  block->z_m[index] = point_m.z();
  block->weight[index] = weight;
}

void Enclose(const HistogramCloud::Block& block, HistogramCloud::Spheres* spheres) {
  using Axis = Eigen::Map<const Eigen::Array<float, HistogramCloud::Block::kSize, 1>>;
  const Axis x(block.x_m.data());
  const Axis y(block.y_m.data());
  const Axis z(block.z_m.data());
  const Eigen::Vector3f low(x.minCoeff(), y.minCoeff(), z.minCoeff());
  const Eigen::Vector3f high(x.maxCoeff(), y.maxCoeff(), z.maxCoeff());
  const Eigen::Vector3f centre = 0.5F * (low + high);
  spheres->x_m.push_back(centre.x());
  spheres->y_m.push_back(centre.y());
  spheres->z_m.push_back(centre.z());
  // A hair more, so that rounding never loses a point on the sphere.
  spheres->radius_m.push_back(0.5F * (high - low).norm() + 1e-5F);
}

}  // namespace

HistogramCloud::HistogramCloud(std::span<const Eigen::Vector3f> points_m, std::span<const float> weights) {
  ORBSLAM_CHECK(weights.empty() || weights.size() == points_m.size());
  blocks_.reserve(points_m.size() / Block::kSize + 1);
  int filled = Block::kSize;
  for (size_t i = 0; i < points_m.size(); ++i) {
    const Eigen::Vector3f& p = points_m[i];
    if (!p.allFinite() || !(p.z() > 0)) continue;
    if (filled == Block::kSize) {
      blocks_.emplace_back();
      filled = 0;
    }
    Append(p, weights.empty() ? p.z() * p.z() : weights[i], filled++, &blocks_.back());
  }
  for (; !blocks_.empty() && filled < Block::kSize; ++filled) {
    const Block& last = blocks_.back();
    Append({last.x_m[0], last.y_m[0], last.z_m[0]}, 0, filled, &blocks_.back());
  }
  for (const Block& block : blocks_) Enclose(block, &spheres_);
}

double SurfaceWeight(std::span<const Eigen::Vector3f> points_m) {
  double sum = 0;
  for (const Eigen::Vector3f& point : points_m) sum += point.z() * point.z();
  return sum;
}

float HistogramBinM(float depth_m) {
  return std::max(kMinBinM, static_cast<float>(2 * DepthModel::SigmaM(depth_m)));
}

MotionHistogram BuildMotionHistogram(std::span<const HistogramRow> rows, const SweptVolume& volume) {
  MotionHistogram histogram;
  for (const HistogramRow& row : rows) histogram.times_s.push_back(row.time_s);
  ORBSLAM_CHECK(std::is_sorted(histogram.times_s.begin(), histogram.times_s.end()));
  const float reach_m = volume.max_speed_mps * static_cast<float>(histogram.DurationS());
  const float half_length_m = reach_m + volume.ball.radius_m;
  histogram.max_speed_mps = volume.max_speed_mps;
  histogram.bin_m = HistogramBinM(volume.ball.centre_m.z());
  // An odd number, so that the ball's centre is the centre of a bin.
  const int half_bins = static_cast<int>(std::ceil(half_length_m / histogram.bin_m));
  const int num_bins = 2 * half_bins + 1;
  histogram.first_m = -static_cast<float>(half_bins) * histogram.bin_m;
  histogram.weights = MotionHistogram::Matrix::Zero(static_cast<Eigen::Index>(rows.size()), num_bins);
  const auto fill_row = HasWideVectors() ? FillRowWide : FillRow;
  for (size_t i = 0; i < rows.size(); ++i) {
    fill_row(*rows[i].cloud, InFrameOf(rows[i], volume, reach_m), histogram.first_m, histogram.bin_m,
             num_bins, histogram.weights.row(static_cast<Eigen::Index>(i)).data());
  }
  return histogram;
}

ClusterExtent ExtentAlong(std::span<const Eigen::Vector3f> points_m, const SweptVolume& volume) {
  ClusterExtent extent{volume.ball.radius_m, -volume.ball.radius_m};
  for (const Eigen::Vector3f& point : points_m) {
    if (!volume.ball.Contains(point)) continue;
    const float along = volume.direction.dot(point - volume.ball.centre_m);
    extent = {std::min(extent.low_m, along), std::max(extent.high_m, along)};
  }
  return extent.low_m > extent.high_m ? ClusterExtent{} : extent;
}

}  // namespace orbslam
