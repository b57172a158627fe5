// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimization/pose_cost.h"

#include <gtest/gtest.h>

#include "optimization/scene.h"

namespace orbslam {
namespace {

using Residuals = Eigen::Matrix<double, 7, 1>;
using Jacobian = Eigen::Matrix<double, 7, 6>;

double HalfCost(const PoseCost& cost, const Vector6d& x) {
  Residuals r;
  cost(x.data(), r.data(), nullptr);
  return 0.5 * r.squaredNorm();
}

PoseCost RandomCost(Rng* rng, double noise_px) {
  const StereoIntrinsics k = test::Kinect();
  const Rigid3d b_from_a = test::RandomMotion(rng, 0.5, 0.5);
  PoseCost cost(k, b_from_a);
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d x_a = test::RandomVisiblePoint(k, rng), x_b = test::RandomVisiblePoint(k, rng);
    const bool has_depth = i % 2 == 0;
    cost.AddForward(Inverse(b_from_a) * x_b, {test::Measure(k, x_b, noise_px, has_depth, rng), 0.7, 6});
    cost.AddBackward(b_from_a * x_a, {test::Measure(k, x_a, noise_px, has_depth, rng), 1.3, 6});
  }
  return cost;
}

Vector6d NumericGradient(const PoseCost& cost, const Vector6d& x) {
  Vector6d gradient;
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = 1e-6 * Vector6d::Unit(i);
    gradient[i] = (HalfCost(cost, x + step) - HalfCost(cost, x - step)) / 2e-6;
  }
  return gradient;
}

TEST(PoseCost, GradientIsThatOfTheCost) {
  Rng rng(1);
  for (int trial = 0; trial < 20; ++trial) {
    PoseCost cost = RandomCost(&rng, trial);  // from no outliers to many
    for (bool robust : {true, false}) {
      cost.SetRobust(robust);
      Vector6d x;
      x << test::RandomVector(&rng, 0.02), test::RandomVector(&rng, 0.02);
      Residuals r;
      Jacobian j;
      cost(x.data(), r.data(), j.data());
      const Vector6d numeric = NumericGradient(cost, x);
      EXPECT_LT((j.transpose() * r - numeric).norm(), 1e-6 * numeric.norm());
      EXPECT_NEAR(0.5 * r.squaredNorm(), HalfCost(cost, x), 1e-9 * HalfCost(cost, x));
    }
  }
}

TEST(PoseCost, WithoutErrorsTheGaussNewtonHessianIsExact) {
  Rng rng(2);
  const PoseCost cost = RandomCost(&rng, 0);
  Residuals r;
  Jacobian j;
  const Vector6d zero = Vector6d::Zero();
  cost(zero.data(), r.data(), j.data());
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = 1e-5 * Vector6d::Unit(i);
    const Vector6d column = (NumericGradient(cost, step) - NumericGradient(cost, -step)) / 2e-5;
    EXPECT_LT((j.transpose() * j.col(i) - column).norm(), 1e-5 * column.norm());
  }
}

TEST(PoseCost, InactiveObservationsDoNotCount) {
  Rng rng(3);
  PoseCost cost = RandomCost(&rng, 3);
  for (int i = 0; i < cost.NumObservations(); ++i) cost.SetActive(i, false);
  Residuals r;
  Jacobian j;
  const Vector6d zero = Vector6d::Zero();
  cost(zero.data(), r.data(), j.data());
  EXPECT_TRUE(r.isZero(0));
  EXPECT_TRUE(j.isZero(0));
}

}  // namespace
}  // namespace orbslam
