// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/triangulation.h"

#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {
namespace {

class TriangulationTest : public testing::Test {
 protected:
  /// A point that both cameras have in front of them, in a; its rays of any length.
  void Draw() {
    a_from_b_ = {So3Exp(rng_.Uniform(0, 0.5) * RandomDirection(&rng_)),
                 rng_.Uniform(0.1, 1) * RandomDirection(&rng_)};
    x_a_ = {rng_.Uniform(-1, 1), rng_.Uniform(-1, 1), rng_.Uniform(2, 6)};
    direction_a_ = rng_.Uniform(0.1, 5) * x_a_;
    direction_b_ = rng_.Uniform(0.1, 5) * (Inverse(a_from_b_) * x_a_);
  }

  Rng rng_{8};
  Rigid3d a_from_b_;
  Eigen::Vector3d x_a_, direction_a_, direction_b_;
};

TEST_F(TriangulationTest, RaysWithoutNoiseMeetInThePoint) {
  for (int i = 0; i < 100; ++i) {
    Draw();
    const auto found = TriangulateMidpoint(a_from_b_, direction_a_, direction_b_);
    ASSERT_TRUE(found);
    EXPECT_THAT(*found, MatrixNear(x_a_, 1e-8));
  }
}

TEST_F(TriangulationTest, TheMidpointIsNoFartherFromTheRaysThanAnyPointNearby) {
  const auto distances2 = [&](const Eigen::Vector3d& x) {
    const Eigen::Vector3d d = direction_a_.normalized(), e = (a_from_b_.rotation * direction_b_).normalized();
    return d.cross(x).squaredNorm() + e.cross(x - a_from_b_.translation).squaredNorm();
  };
  for (int i = 0; i < 100; ++i) {
    Draw();
    direction_b_ += 0.01 * direction_b_.norm() * RandomDirection(&rng_);
    const auto found = TriangulateMidpoint(a_from_b_, direction_a_, direction_b_);
    if (!found) continue;
    for (int k = 0; k < 10; ++k) {
      EXPECT_LE(distances2(*found), distances2(*found + 1e-3 * RandomDirection(&rng_)));
    }
  }
}

TEST_F(TriangulationTest, ParallelRaysAndPointsBehindACameraGiveNothing) {
  for (int i = 0; i < 100; ++i) {
    Draw();
    EXPECT_FALSE(TriangulateMidpoint(a_from_b_, direction_a_, -direction_b_));
    EXPECT_FALSE(TriangulateMidpoint(a_from_b_, -direction_a_, direction_b_));
    const Eigen::Vector3d parallel = a_from_b_.rotation.conjugate() * direction_a_;
    EXPECT_FALSE(TriangulateMidpoint(a_from_b_, direction_a_, parallel));
  }
}

TEST_F(TriangulationTest, EssentialMatrixHoldsForDirectionsOfOnePointOnly) {
  for (int i = 0; i < 100; ++i) {
    Draw();
    const Eigen::Matrix3d essential = EssentialMatrix(Inverse(a_from_b_));
    const Eigen::Vector3d line = (essential * direction_a_.normalized()).normalized();
    EXPECT_NEAR(direction_b_.normalized().dot(line), 0, 1e-9);
    EXPECT_NEAR((direction_b_.normalized() + 0.1 * line).dot(line), 0.1, 1e-9);
    EXPECT_NEAR(essential.determinant(), 0, 1e-9);
  }
}

}  // namespace
}  // namespace orbslam::test
