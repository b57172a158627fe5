// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/motion_histogram.h"

#include <algorithm>
#include <cmath>

#include "orbslam/camera/depth_model.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

constexpr int kRunLength = 16;
constexpr float kMinBinM = 0.02F;

/// A capsule in one cloud's frame: the points within radius of a segment of 2 reach round the centre.
struct Capsule {
  Eigen::Vector3f centre;
  Eigen::Vector3f direction;
  float reach;
  float radius;

  float Along(const Eigen::Vector3f& point) const { return direction.dot(point - centre); }

  float SquaredDistance(const Eigen::Vector3f& point, float along) const {
    const float nearest = std::clamp(along, -reach, reach);
    return (point - centre - nearest * direction).squaredNorm();
  }
};

Capsule InFrameOf(const HistogramRow& row, const SweptVolume& volume, float reach_m) {
  const Rigid3d cloud_from_current = Inverse(row.current_from_cloud);
  return {(cloud_from_current * volume.ball.centre_m.cast<double>()).cast<float>(),
          (cloud_from_current.rotation * volume.direction.cast<double>()).cast<float>(), reach_m,
          volume.ball.radius_m};
}

/// Adds `weight` at `position`, in bins from the centre of the first one.
void Splat(float position, float weight, int num_bins, float* bins) {
  const float floor = std::floor(position);
  const float share = weight * (position - floor);
  const int low = static_cast<int>(floor);
  bins[std::clamp(low, 0, num_bins - 1)] += weight - share;
  bins[std::clamp(low + 1, 0, num_bins - 1)] += share;
}

void FillRow(const HistogramCloud& cloud, const Capsule& capsule, float first_m, float bin_m, int num_bins,
             float* bins) {
  const float squared_radius = capsule.radius * capsule.radius;
  const float per_bin = 1.0F / bin_m;
  for (const HistogramCloud::Run& run : cloud.runs()) {
    const float limit = capsule.radius + run.radius_m;
    if (capsule.SquaredDistance(run.centre_m, capsule.Along(run.centre_m)) > limit * limit) continue;
    for (const Eigen::Vector4f& point : cloud.points().subspan(run.begin, run.end - run.begin)) {
      const Eigen::Vector3f position = point.head<3>();
      const float along = capsule.Along(position);
      if (capsule.SquaredDistance(position, along) > squared_radius) continue;
      Splat((along - first_m) * per_bin, point.w(), num_bins, bins);
    }
  }
}

HistogramCloud::Run Enclose(std::span<const Eigen::Vector4f> points, int begin, int end) {
  Eigen::Vector3f low = points[begin].head<3>();
  Eigen::Vector3f high = low;
  for (int i = begin + 1; i < end; ++i) {
    low = low.cwiseMin(points[i].head<3>());
    high = high.cwiseMax(points[i].head<3>());
  }
  // A hair more, so that rounding never loses a point on the sphere.
  return {0.5F * (low + high), 0.5F * (high - low).norm() + 1e-5F, begin, end};
}

}  // namespace

HistogramCloud::HistogramCloud(std::span<const Eigen::Vector3f> points_m, std::span<const float> weights) {
  ORBSLAM_CHECK(weights.empty() || weights.size() == points_m.size());
  points_.reserve(points_m.size());
  for (size_t i = 0; i < points_m.size(); ++i) {
    const Eigen::Vector3f& p = points_m[i];
    if (!p.allFinite() || !(p.z() > 0)) continue;
    points_.emplace_back(p.x(), p.y(), p.z(), weights.empty() ? p.z() * p.z() : weights[i]);
  }
  const int num_points = static_cast<int>(points_.size());
  runs_.reserve(points_.size() / kRunLength + 1);
  for (int begin = 0; begin < num_points; begin += kRunLength) {
    runs_.push_back(Enclose(points_, begin, std::min(begin + kRunLength, num_points)));
  }
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
  for (size_t i = 0; i < rows.size(); ++i) {
    FillRow(*rows[i].cloud, InFrameOf(rows[i], volume, reach_m), histogram.first_m, histogram.bin_m, num_bins,
            histogram.weights.row(static_cast<Eigen::Index>(i)).data());
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
