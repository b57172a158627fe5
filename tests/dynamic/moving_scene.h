// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "orbslam/camera/depth_model.h"
#include "orbslam/dynamic/line_integral.h"
#include "orbslam/dynamic/motion_histogram.h"
#include "orbslam/dynamic/motion_vectors.h"
#include "orbslam/util/random.h"

namespace orbslam {

/// A box, turned round the vertical; metres, camera frame (x right, y down, z forward).
struct SceneBox {
  Eigen::Vector3d centre;
  Eigen::Vector3d half_size;
  double yaw = 0;

  /// Distance along the unit-z ray at which it enters, that is the depth.
  std::optional<double> DepthAlong(const Eigen::Vector3d& ray) const {
    const auto turned = [this](const Eigen::Vector3d& v) {
      return Eigen::Vector3d(std::cos(yaw) * v.x() - std::sin(yaw) * v.z(), v.y(),
                             std::sin(yaw) * v.x() + std::cos(yaw) * v.z());
    };
    const Eigen::Array3d direction = turned(ray).array();
    const Eigen::Array3d to_centre = turned(centre).array();
    const Eigen::Array3d first = (to_centre - half_size.array() * direction.sign()) / direction;
    const Eigen::Array3d last = (to_centre + half_size.array() * direction.sign()) / direction;
    const double depth = first.maxCoeff();
    return depth > 0 && depth <= last.minCoeff() ? std::optional(depth) : std::nullopt;
  }
};

/// A cloud of 160 x 120 pixels in raster order and which box each point belongs to.
struct SceneCloud {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<int> boxes;
  std::vector<int> pixels;

  std::vector<Eigen::Vector3f> Of(int box) const {
    std::vector<Eigen::Vector3f> result;
    for (size_t i = 0; i < points_m.size(); ++i) {
      if (boxes[i] == box) result.push_back(points_m[i]);
    }
    return result;
  }
};

/// What a Kinect sees of the boxes: depth with its noise, a share of the pixels without depth.
inline SceneCloud Observe(const std::vector<SceneBox>& boxes, Rng* rng, double dropout = 0.05) {
  constexpr int kWidth = 160;
  constexpr int kHeight = 120;
  constexpr double kFocalPx = 131.25;
  SceneCloud cloud;
  for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
    const Eigen::Vector3d ray((pixel % kWidth - 79.5) / kFocalPx, (pixel / kWidth - 59.5) / kFocalPx, 1.0);
    double nearest = std::numeric_limits<double>::max();
    int nearest_box = -1;
    for (size_t i = 0; i < boxes.size(); ++i) {
      const std::optional<double> depth = boxes[i].DepthAlong(ray);
      if (!depth || *depth >= nearest) continue;
      nearest = *depth;
      nearest_box = static_cast<int>(i);
    }
    if (nearest_box < 0 || rng->Uniform() < dropout) continue;
    const double measured = nearest + DepthModel::SigmaM(nearest) * rng->Gaussian();
    cloud.points_m.push_back((measured * ray).cast<float>());
    cloud.boxes.push_back(nearest_box);
    cloud.pixels.push_back(pixel);
  }
  return cloud;
}

/// The boxes at a time; the first is the one that is judged.
using SceneAt = std::function<std::vector<SceneBox>(double time_s)>;

/// What the histogram says about box 0, nine frames at 30 Hz up to time 0.
struct Judgement {
  std::optional<Eigen::Vector3f> direction;
  LineIntegral published;
  LineIntegral persistent;
  LineIntegral gain;
  Eigen::Vector3f VelocityMps() const { return static_cast<float>(gain.velocity_mps) * *direction; }
};

inline constexpr double kFramePeriodS = 1.0 / 30.0;

/// `direction`: along W; without it, W is the singular vector of V.
inline Judgement JudgeFirstBox(const SceneAt& scene, uint64_t seed,
                               std::optional<Eigen::Vector3f> direction = std::nullopt,
                               double dropout = 0.05) {
  std::vector<HistogramCloud> clouds;
  std::vector<HistogramRow> rows(kMotionHistogramRows);
  std::vector<Eigen::Vector3f> cluster;
  std::vector<Eigen::Vector3f> previous;
  clouds.reserve(kMotionHistogramRows);
  for (int i = 0; i < kMotionHistogramRows; ++i) {
    Rng rng(seed, static_cast<uint64_t>(i));
    const double time_s = (i - kMotionHistogramRows + 1) * kFramePeriodS;
    const SceneCloud cloud = Observe(scene(time_s), &rng, dropout);
    previous = std::exchange(cluster, cloud.Of(0));
    clouds.emplace_back(cloud.points_m);
    rows[i] = {&clouds.back(), {}, time_s};
  }
  Judgement judgement;
  const MotionBall ball = BallAroundCluster(cluster);
  judgement.direction =
      direction ? direction : MotionDirection(MotionVectors(PointsInBall(cluster, ball), previous));
  if (!judgement.direction) return judgement;
  const SweptVolume volume{ball, *judgement.direction};
  const MotionHistogram histogram = BuildMotionHistogram(rows, volume);
  const double weight = SurfaceWeight(cluster);
  judgement.published = PublishedLineIntegral(histogram, weight);
  judgement.persistent = PersistentLineIntegral(histogram, ExtentAlong(cluster, volume), weight);
  judgement.gain = GainOverRest(histogram, ExtentAlong(cluster, volume), weight);
  return judgement;
}

/// A box as wide and deep as a standing person, and a wall 2 m behind it.
inline SceneAt PersonBefore(const Eigen::Vector3d& centre, const Eigen::Vector3d& velocity_mps,
                            double turn_rad_s = 0) {
  return [=](double time_s) {
    const SceneBox person{centre + time_s * velocity_mps, {0.22, 0.6, 0.12}, turn_rad_s * time_s};
    const SceneBox wall{{0, 0, centre.z() + 2.1}, {6, 4, 0.1}};
    return std::vector<SceneBox>{person, wall};
  };
}

}  // namespace orbslam
