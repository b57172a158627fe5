// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/motion_histogram.h"

#include <gtest/gtest.h>

#include <numeric>

#include "moving_scene.h"

namespace orbslam {
namespace {

Eigen::Vector3f RandomDirection(Rng* rng) {
  return Eigen::Vector3d(rng->Gaussian(), rng->Gaussian(), rng->Gaussian()).normalized().cast<float>();
}

std::vector<Eigen::Vector3f> RandomRoom(int count, Rng* rng) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        Eigen::Vector3d(rng->Uniform(-2, 2), rng->Uniform(-1, 1), rng->Uniform(0.5, 4)).cast<float>());
  }
  return points;
}

double DistanceToSegment(const Eigen::Vector3f& point, const SweptVolume& volume, float reach_m) {
  const Eigen::Vector3f from_centre = point - volume.ball.centre_m;
  const float along = std::clamp(from_centre.dot(volume.direction), -reach_m, reach_m);
  return (from_centre - along * volume.direction).norm();
}

TEST(MotionHistogram, HoldsTheWeightOfThePointsInTheSweptVolume) {
  Rng rng(1);
  for (int trial = 0; trial < 30; ++trial) {
    const auto points = RandomRoom(3000, &rng);
    const HistogramCloud cloud(points);
    const std::vector<HistogramRow> rows{{&cloud, {}, -0.2}, {&cloud, {}, 0}};
    const SweptVolume volume{{{0.3F, 0, 2}, static_cast<float>(rng.Uniform(0.1, 0.8))},
                             RandomDirection(&rng)};
    const MotionHistogram histogram = BuildMotionHistogram(rows, volume);
    double expected = 0;
    for (const auto& point : points) {
      if (DistanceToSegment(point, volume, 0.3F) <= volume.ball.radius_m) expected += point.z() * point.z();
    }
    EXPECT_NEAR(histogram.weights.row(0).sum(), expected, 1e-4 * expected);
    EXPECT_EQ(histogram.weights.row(0), histogram.weights.row(1));
  }
}

TEST(MotionHistogram, DoesNotSeeTheCamerasOwnMotion) {
  Rng rng(2);
  const auto points = RandomRoom(3000, &rng);
  const Rigid3d current_from_past{Eigen::Quaterniond(0.99, 0.03, -0.05, 0.02).normalized(),
                                  {0.1, -0.05, 0.2}};
  std::vector<Eigen::Vector3f> past;
  for (const auto& p : points) past.push_back((Inverse(current_from_past) * p.cast<double>()).cast<float>());
  const std::vector<float> ones(points.size(), 1);
  const HistogramCloud cloud(points, ones);
  const HistogramCloud past_cloud(past, ones);
  const std::vector<HistogramRow> rows{{&past_cloud, current_from_past, -0.2}, {&cloud, {}, 0}};
  const MotionHistogram histogram = BuildMotionHistogram(rows, {{{0, 0, 2}, 0.5F}, RandomDirection(&rng)});
  // A point may change sides at the volume's surface.
  EXPECT_LT((histogram.weights.row(0) - histogram.weights.row(1)).cwiseAbs().sum(), 2);
  EXPECT_GT(histogram.weights.sum(), 100);
}

TEST(MotionHistogram, PutsAPointWhereItIsAlongTheDirection) {
  for (float along = -0.3F; along <= 0.3F; along += 0.013F) {
    const std::vector<Eigen::Vector3f> points{{along, 0, 2}};
    const HistogramCloud cloud(points);
    const std::vector<HistogramRow> rows{{&cloud, {}, -0.1}, {&cloud, {}, 0}};
    const MotionHistogram histogram =
        BuildMotionHistogram(rows, {{{0, 0, 2}, 0.2F}, Eigen::Vector3f::UnitX()});
    double mean = 0;
    for (int bin = 0; bin < histogram.weights.cols(); ++bin) {
      mean += histogram.weights(0, bin) * (histogram.first_m + static_cast<float>(bin) * histogram.bin_m);
    }
    EXPECT_NEAR(mean / histogram.weights.row(0).sum(), along, 1e-4);
  }
}

TEST(MotionHistogram, ASurfaceWeighsTheSameAtAnyDistance) {
  const auto weight_at = [](double distance_m) {
    Rng rng(3);
    return SurfaceWeight(Observe({{{0, 0, distance_m}, {0.3, 0.4, 0.01}}}, &rng).Of(0));
  };
  EXPECT_NEAR(weight_at(1.5), weight_at(3), 0.1 * weight_at(3));
}

TEST(HistogramCloud, LeavesOutWhatIsNoMeasurement) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const HistogramCloud cloud(std::vector<Eigen::Vector3f>{{0, 0, 0}, {0, nan, 1}, {0, 0, 1}, {0, 0, -1}});
  ASSERT_EQ(cloud.blocks().size(), 1U);
  EXPECT_EQ(std::accumulate(cloud.blocks()[0].weight.begin(), cloud.blocks()[0].weight.end(), 0.0F), 1.0F);
  EXPECT_TRUE(HistogramCloud(std::span<const Eigen::Vector3f>()).blocks().empty());
}

TEST(ExtentAlong, IsThatOfThePointsInTheBall) {
  const SweptVolume volume{{{0, 0, 2}, 0.5F}, Eigen::Vector3f::UnitX()};
  const ClusterExtent extent =
      ExtentAlong(std::vector<Eigen::Vector3f>{{-0.2F, 0, 2}, {0.3F, 0, 2}, {9, 0, 2}}, volume);
  EXPECT_FLOAT_EQ(extent.low_m, -0.2F);
  EXPECT_FLOAT_EQ(extent.high_m, 0.3F);
}

}  // namespace
}  // namespace orbslam
