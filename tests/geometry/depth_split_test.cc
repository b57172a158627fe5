// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/geometry/depth_split.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.h"

namespace orbslam::test {
namespace {

std::vector<double> Depths(int num, double from_m, double to_m, Rng* rng) {
  std::vector<double> depths_m;
  for (int i = 0; i < num; ++i) depths_m.push_back(rng->Uniform(from_m, to_m));
  return depths_m;
}

TEST(DepthSplit, PartsTwoLayersHoweverManyEachHas) {
  Rng rng(1);
  for (const int num_near : {10, 100, 400}) {
    std::vector<double> depths_m = Depths(num_near, 1.4, 1.7, &rng);
    std::ranges::copy(Depths(200, 2.6, 3.4, &rng), std::back_inserter(depths_m));
    EXPECT_GT(SplitDepthM(depths_m), 1.69) << num_near;
    EXPECT_LT(SplitDepthM(depths_m), 2.61) << num_near;
  }
}

TEST(DepthSplit, KnowsNoUnit) {
  Rng rng(2);
  std::vector<double> depths_m = Depths(200, 0.5, 5, &rng);
  const double split_m = SplitDepthM(depths_m);
  for (double& depth_m : depths_m) depth_m *= 3;
  EXPECT_NEAR(SplitDepthM(depths_m), 3 * split_m, 1e-9);
}

TEST(DepthSplit, OfOneDepthThereIsNone) {
  EXPECT_EQ(SplitDepthM({}), 0);
  EXPECT_EQ(SplitDepthM({2}), 0);
  EXPECT_EQ(SplitDepthM({2, 2, 2}), 0);
}

}  // namespace
}  // namespace orbslam::test
