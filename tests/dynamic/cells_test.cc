// SPDX-License-Identifier: GPL-3.0-or-later
#include "cells.h"

#include <gtest/gtest.h>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

/// Of any size, one cell and one row included.
class CountAroundTest : public testing::TestWithParam<cv::Size> {};
INSTANTIATE_TEST_SUITE_P(Sizes, CountAroundTest,
                         testing::Values(cv::Size(1, 1), cv::Size(37, 1), cv::Size(1, 5), cv::Size(67, 31)));

TEST_P(CountAroundTest, CountsTheNonZeroOfNineAndNothingBeyondTheRim) {
  Rng rng(7);
  cv::Mat1b cells(GetParam());
  for (uint8_t& cell : cells) cell = rng.Uniform() < 0.5 ? 0 : static_cast<uint8_t>(1 + rng.Below(255));
  const cv::Mat1b count = CountAround(cells);
  ASSERT_EQ(count.size(), cells.size());
  const cv::Rect inside({0, 0}, cells.size());
  for (int v = 0; v < cells.rows; ++v)
    for (int u = 0; u < cells.cols; ++u)
      EXPECT_EQ(count(v, u), cv::countNonZero(cells(cv::Rect(u - 1, v - 1, 3, 3) & inside))) << u << " " << v;
}

}  // namespace
}  // namespace orbslam
