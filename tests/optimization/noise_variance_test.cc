// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimization/noise_variance.h"

#include <gtest/gtest.h>

#include <limits>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

/// Of errors with that standard deviation, which were said to have 1 px; outliers are anywhere.
double Estimate(int num_errors, double sigma_px, double outlier_share, int num_dof) {
  Rng rng(1);
  NoiseVariance noise;
  for (int i = 0; i < num_errors; ++i) {
    double chi2 = 0;
    for (int axis = 0; axis < num_dof; ++axis) {
      const double error = rng.Gaussian();
      chi2 += sigma_px * sigma_px * error * error;
    }
    const bool is_outlier = rng.Uniform() < outlier_share;
    noise.Add(is_outlier ? rng.Uniform(0, 1e4) : chi2, num_dof);
  }
  return noise.Estimate();
}

TEST(NoiseVariance, IsThatOfTheErrorsWhateverWasSaidOfThem) {
  for (const int num_dof : {2, 3})
    for (const double sigma_px : {0.3, 0.5, 0.9})
      EXPECT_NEAR(Estimate(20000, sigma_px, 0, num_dof) / (sigma_px * sigma_px), 1, 0.05)
          << num_dof << " " << sigma_px;
}

TEST(NoiseVariance, OutliersDoNotDoubleItUpToAThird) {
  for (const int num_dof : {2, 3}) {
    EXPECT_GT(Estimate(20000, 0.3, 0.3, num_dof), 0.09);
    EXPECT_LT(Estimate(20000, 0.3, 0.3, num_dof), 2 * 0.09);
  }
}

TEST(NoiseVariance, IsNeitherMoreThanWasSaidNorNothing) {
  EXPECT_EQ(Estimate(1000, 0.3, 0.9, 2), 1);
  EXPECT_EQ(Estimate(1000, 2, 0, 3), 1);
  EXPECT_GT(Estimate(1000, 0, 0, 2), 0);
  NoiseVariance exact;
  exact.Add(0, 2);
  EXPECT_EQ(exact.Estimate(0.02), 0.02);
  EXPECT_EQ(Estimate(0, 0, 0, 2), 1);
  NoiseVariance behind_the_camera;
  behind_the_camera.Add(std::numeric_limits<double>::infinity(), 2);
  behind_the_camera.Add(std::numeric_limits<double>::quiet_NaN(), 3);
  EXPECT_EQ(behind_the_camera.Estimate(), 1);
}

}  // namespace
}  // namespace orbslam
