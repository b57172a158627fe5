// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmenter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

/// Surfaces side by side, with steps between them and holes in them.
cv::Mat1f Surfaces(Rng* rng) {
  cv::Mat1f depth_m(37, 53);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u) {
      const int surface = u / 9 + 3 * (v / 13);
      depth_m(v, u) = rng->Uniform() < 0.1 ? 0.f : 1.f + 0.07f * static_cast<float>(surface * 5 % 7);
    }
  return depth_m;
}

cv::Mat1b Some(cv::Size size, double share, Rng* rng) {
  cv::Mat1b some(size);
  for (uint8_t& cell : some) cell = rng->Uniform() < share ? 255 : 0;
  return some;
}

class SeededClustersTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(MinCells, SeededClustersTest, testing::Values(1, 12));

TEST_P(SeededClustersTest, AreTheComponentsThatHoldASeed) {
  Rng rng(11);
  size_t num_found = 0, num_left_out = 0;
  for (int round = 0; round < 20; ++round) {
    const cv::Mat1f depth_m = Surfaces(&rng);
    const cv::Mat1b included = Some(depth_m.size(), 0.8, &rng), seeds = Some(depth_m.size(), 0.01, &rng);
    std::vector<Cluster> expected = SegmentCells(depth_m, included, GetParam()).clusters;
    num_left_out += std::erase_if(expected, [&](const Cluster& cluster) {
      return std::ranges::none_of(cluster.cells, [&](int cell) { return seeds(cell) != 0; });
    });
    const std::vector<Cluster> found = SeededClusters(depth_m, included, seeds, GetParam());
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].cells, expected[i].cells);
    num_found += found.size();
  }
  EXPECT_GT(num_found, 100u);
  EXPECT_GT(num_left_out, 20u);
}

TEST(SeededClusters, GoRoundNoEdgeOfTheImage) {
  cv::Mat1f depth_m(3, 4, 0.f);
  depth_m(0, 3) = depth_m(1, 0) = 2.f;  // one behind the other in memory
  const cv::Mat1b all(depth_m.size(), uint8_t{255});
  EXPECT_EQ(SeededClusters(depth_m, all, all, 1).size(), 2u);
}

}  // namespace
}  // namespace orbslam
