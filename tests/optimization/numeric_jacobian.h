// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

namespace orbslam::test {

/// Every analytic Jacobian of the cost against central differences, relative to the largest entry of its
/// block.
inline void ExpectJacobiansAreRight(const ceres::CostFunction& cost, std::vector<std::vector<double>> blocks,
                                    double relative_tolerance) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int rows = cost.num_residuals();
  std::vector<const double*> parameters;
  std::vector<RowMajor> analytic;
  std::vector<double*> jacobians;
  for (const std::vector<double>& block : blocks) {
    parameters.push_back(block.data());
    analytic.push_back(RowMajor::Random(rows, static_cast<int>(block.size())));
  }
  for (RowMajor& j : analytic) jacobians.push_back(j.data());
  Eigen::VectorXd residuals(rows), ahead(rows), behind(rows);
  ASSERT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), jacobians.data()));
  for (size_t b = 0; b < blocks.size(); ++b) {
    RowMajor numeric(rows, static_cast<int>(blocks[b].size()));
    for (size_t i = 0; i < blocks[b].size(); ++i) {
      const double value = blocks[b][i], step = 1e-6;
      blocks[b][i] = value + step;
      cost.Evaluate(parameters.data(), ahead.data(), nullptr);
      blocks[b][i] = value - step;
      cost.Evaluate(parameters.data(), behind.data(), nullptr);
      blocks[b][i] = value;
      numeric.col(static_cast<int>(i)) = (ahead - behind) / (2 * step);
    }
    EXPECT_LT((analytic[b] - numeric).norm(), relative_tolerance * numeric.norm()) << "block " << b;
  }
}

}  // namespace orbslam::test
