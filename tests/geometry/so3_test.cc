// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/so3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {
namespace {

constexpr double kPi = std::numbers::pi;

class So3 : public testing::Test {
 protected:
  Rng rng_{1};
};

TEST_F(So3, LogInvertsExpAtEveryAngle) {
  for (const double angle :
       {0.0, 1e-300, 1e-15, 1e-9, 0.99e-4, 1.01e-4, 0.1, 1.0, 3.0, kPi - 1e-4, kPi - 1e-9}) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d w = angle * RandomDirection(&rng_);
      EXPECT_THAT(So3Log(So3Exp(w)), MatrixNear(w, 1e-14 + 1e-14 * angle)) << "angle " << angle;
    }
  }
}

TEST_F(So3, SmallRotationsKeepTheirRelativePrecision) {
  const Eigen::Vector3d w = 1e-10 * RandomDirection(&rng_);
  EXPECT_LT((So3Log(So3Exp(w)) - w).norm(), 1e-14 * w.norm());
}

TEST_F(So3, ExpInvertsLogForBothSignsOfTheQuaternion) {
  for (int i = 0; i < 200; ++i) {
    const Eigen::Quaterniond q(
        Eigen::Vector4d(rng_.Gaussian(), rng_.Gaussian(), rng_.Gaussian(), rng_.Gaussian()).normalized());
    const Eigen::Vector3d w = So3Log(q);
    EXPECT_LE(w.norm(), kPi + 1e-15);
    EXPECT_THAT(So3Exp(w).toRotationMatrix(), MatrixNear(q.toRotationMatrix(), 1e-14));
    EXPECT_THAT(So3Log(Eigen::Quaterniond(-q.coeffs())), MatrixNear(w, 1e-14));
  }
}

TEST_F(So3, ExpEqualsEigensAngleAxis) {
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d axis = RandomDirection(&rng_);
    const double angle = rng_.Uniform(0, 10);
    EXPECT_THAT(So3Exp(angle * axis).toRotationMatrix(),
                MatrixNear(Eigen::AngleAxisd(angle, axis).toRotationMatrix(), 1e-14));
  }
}

TEST_F(So3, CrossMatrixIsTheCrossProduct) {
  const Eigen::Vector3d v = RandomVector(&rng_, 1), w = RandomVector(&rng_, 1);
  EXPECT_THAT(CrossMatrix(v) * w, MatrixNear(v.cross(w), 1e-15));
}

TEST_F(So3, LeftJacobianEqualsNumericDerivative) {
  for (const double angle : {0.0, 1e-6, 0.9e-4, 1.1e-4, 0.01, 1.0, 3.0}) {
    const Eigen::Vector3d w = angle * RandomDirection(&rng_);
    Eigen::Matrix3d numeric;
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d d = kStep * Eigen::Vector3d::Unit(k);
      numeric.col(k) = So3Log(So3Exp(w + d) * So3Exp(w - d).conjugate()) / (2 * kStep);
    }
    EXPECT_THAT(So3LeftJacobian(w), MatrixNear(numeric, 1e-8)) << "angle " << angle;
  }
}

TEST_F(So3, AngularDistanceIsAMetric) {
  for (int i = 0; i < 100; ++i) {
    const auto a = RandomMotion(&rng_).rotation, b = RandomMotion(&rng_).rotation,
               c = RandomMotion(&rng_).rotation;
    EXPECT_NEAR(AngularDistance(a, a), 0, 1e-15);
    EXPECT_NEAR(AngularDistance(a, b), AngularDistance(b, a), 1e-14);
    EXPECT_LE(AngularDistance(a, c), AngularDistance(a, b) + AngularDistance(b, c) + 1e-14);
    EXPECT_NEAR(AngularDistance(c * a, c * b), AngularDistance(a, b), 1e-14)
        << "turning both changes nothing";
  }
}

}  // namespace
}  // namespace orbslam::test
