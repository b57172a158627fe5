// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/motion_vectors.h"

#include <gtest/gtest.h>

#include "moving_scene.h"

namespace orbslam {
namespace {

std::vector<Eigen::Vector3f> RandomCloud(int count, Rng* rng) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        Eigen::Vector3d(rng->Uniform(-1, 1), rng->Uniform(-1, 1), rng->Uniform(1, 3)).cast<float>());
  }
  return points;
}

TEST(MotionVectors, AreTheDifferencesToTheNearestOfAllNeighbours) {
  Rng rng(1);
  const auto points = RandomCloud(80, &rng);
  const auto previous = RandomCloud(60, &rng);
  const auto vectors = MotionVectors(points, previous);
  ASSERT_EQ(vectors.size(), points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    float least = std::numeric_limits<float>::max();
    for (const auto& other : previous) least = std::min(least, (points[i] - other).norm());
    EXPECT_NEAR(vectors[i].norm(), least, 1e-5);
  }
  EXPECT_TRUE(MotionVectors(points, {}).empty());
}

TEST(MotionDirection, IsAlongTheTranslationOfACluster) {
  Rng rng(2);
  for (int trial = 0; trial < 20; ++trial) {
    // Sparse enough for each point's nearest neighbour to be itself, one centimetre away.
    const auto previous = RandomCloud(60, &rng);
    const Eigen::Vector3f direction =
        Eigen::Vector3d(rng.Gaussian(), rng.Gaussian(), rng.Gaussian()).normalized().cast<float>();
    std::vector<Eigen::Vector3f> points;
    for (const auto& point : previous) points.push_back(point + 0.01F * direction);
    const auto found = MotionDirection(MotionVectors(points, previous));
    ASSERT_TRUE(found);
    EXPECT_GT(found->dot(direction), 0.99);
  }
}

TEST(MotionDirection, IsTheLongestUnitCombinationOfTheRows) {
  Rng rng(3);
  const auto vectors = RandomCloud(30, &rng);
  const auto length = [&](const Eigen::Vector3f& direction) {
    double sum = 0;
    for (const auto& v : vectors) sum += std::pow(v.dot(direction), 2);
    return sum;
  };
  const auto found = MotionDirection(vectors);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->norm(), 1, 1e-5);
  for (const auto& other : RandomCloud(200, &rng))
    EXPECT_LE(length(other.normalized()), length(*found) * 1.0001);
  EXPECT_FALSE(MotionDirection({}));
  EXPECT_FALSE(MotionDirection(std::vector<Eigen::Vector3f>(3, Eigen::Vector3f::Zero())));
}

TEST(MotionBall, GrowsWithDistanceAndHoldsTheCluster) {
  for (float distance = 0.3F; distance < 6; distance += 0.1F) {
    EXPECT_LE(MotionBallRadiusM(distance), MotionBallRadiusM(distance + 0.1F));
  }
  Rng rng(4);
  const auto points = RandomCloud(500, &rng);
  const MotionBall own = BallAroundCluster(points);
  EXPECT_GT(PointsInBall(points, own).size(), points.size() / 2);
  for (const auto& point : PointsInBall(points, own))
    EXPECT_LE((point - own.centre_m).norm(), own.radius_m * 1.0001);
}

}  // namespace
}  // namespace orbslam
