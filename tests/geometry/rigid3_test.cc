// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/rigid3.h"

#include <gtest/gtest.h>

#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {
namespace {

class Rigid3 : public testing::Test {
 protected:
  Rng rng_{2};
};

TEST_F(Rigid3, InverseUndoes) {
  for (int i = 0; i < 100; ++i) {
    const Rigid3d b_from_a = RandomMotion(&rng_);
    EXPECT_THAT(Inverse(b_from_a) * b_from_a, Rigid3dNear(Rigid3d(), 1e-14));
    EXPECT_THAT(b_from_a * Inverse(b_from_a), Rigid3dNear(Rigid3d(), 1e-14));
  }
}

TEST_F(Rigid3, ProductMovesPointsOneAfterTheOther) {
  for (int i = 0; i < 100; ++i) {
    const Rigid3d b_from_a = RandomMotion(&rng_), c_from_b = RandomMotion(&rng_),
                  d_from_c = RandomMotion(&rng_);
    const Eigen::Vector3d x_a = RandomVector(&rng_, 3);
    EXPECT_THAT((c_from_b * b_from_a) * x_a, MatrixNear(c_from_b * (b_from_a * x_a), 1e-13));
    EXPECT_THAT((d_from_c * c_from_b) * b_from_a, Rigid3dNear(d_from_c * (c_from_b * b_from_a), 1e-13));
  }
}

TEST_F(Rigid3, LongChainsStayRigid) {
  Rigid3d chain;
  for (int i = 0; i < 100000; ++i) chain = RandomMotion(&rng_, 0.1, 0.01) * chain;
  EXPECT_NEAR(chain.rotation.norm(), 1, 1e-15);
}

Eigen::Matrix3Xd RandomCloud(int num_points, Rng* rng) {
  Eigen::Matrix3Xd points(3, num_points);
  for (int i = 0; i < num_points; ++i) points.col(i) = RandomVector(rng, 1);
  return points;
}

Eigen::Matrix3Xd Moved(const Rigid3d& b_from_a, Eigen::Matrix3Xd points) {
  for (int i = 0; i < points.cols(); ++i) points.col(i) = b_from_a * Eigen::Vector3d(points.col(i));
  return points;
}

TEST_F(Rigid3, AlignPointsRecoversTheMotion) {
  for (const int num_points : {3, 4, 10, 1000}) {
    const Rigid3d b_from_a = RandomMotion(&rng_);
    const Eigen::Matrix3Xd points_a = RandomCloud(num_points, &rng_);
    EXPECT_THAT(AlignPoints(Moved(b_from_a, points_a), points_a), Rigid3dNear(b_from_a, 1e-12)) << num_points;
  }
}

TEST_F(Rigid3, AlignPointsOfAPlaneGivesARotationAndNoReflection) {
  for (int i = 0; i < 20; ++i) {
    const Rigid3d b_from_a = RandomMotion(&rng_);
    Eigen::Matrix3Xd points_a = RandomCloud(20, &rng_);
    points_a.row(2).setZero();
    EXPECT_THAT(AlignPoints(Moved(b_from_a, points_a), points_a), Rigid3dNear(b_from_a, 1e-12));
  }
}

TEST_F(Rigid3, AlignPointsIsALeastSquaresMinimum) {
  const Eigen::Matrix3Xd points_a = RandomCloud(50, &rng_);
  const Eigen::Matrix3Xd points_b = Moved(RandomMotion(&rng_), points_a) + 0.1 * RandomCloud(50, &rng_);
  const Rigid3d best = AlignPoints(points_b, points_a);
  const double least = (points_b - Moved(best, points_a)).squaredNorm();
  for (int i = 0; i < 100; ++i) {
    const Rigid3d other = RandomMotion(&rng_, 0.01, 0.01) * best;
    EXPECT_LE(least, (points_b - Moved(other, points_a)).squaredNorm());
  }
}

}  // namespace
}  // namespace orbslam::test
