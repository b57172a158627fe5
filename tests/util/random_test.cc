// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace orbslam::test {
namespace {

std::vector<uint64_t> Draws(Rng rng, int count = 100) {
  std::vector<uint64_t> draws(count);
  for (uint64_t& draw : draws) draw = rng();
  return draws;
}

TEST(Rng, IsSplitMix64) {
  // The first numbers of the generator's reference implementation for seed 1234567.
  EXPECT_EQ(Draws(Rng(1234567), 3),
            (std::vector<uint64_t>{6457827717110365317u, 3203168211198807973u, 9817491932198370423u}));
}

TEST(Rng, RepeatsForTheSameKey) { EXPECT_EQ(Draws(Rng(1, 2, 3)), Draws(Rng(1, 2, 3))); }

TEST(Rng, StreamsOfDifferentKeysShareNoNumbers) {
  std::set<uint64_t> seen;
  size_t num_draws = 0;
  for (const uint64_t seed : {0, 1, 2}) {
    for (const uint64_t frame : {0, 1, 2, 3}) {
      for (const uint64_t purpose : {0, 1, 2, 3}) {
        for (const uint64_t draw : Draws(Rng(seed, frame, purpose))) {
          seen.insert(draw);
          ++num_draws;
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), num_draws);
}

TEST(Rng, BelowCoversItsRangeEvenly) {
  Rng rng(4);
  std::vector<int> count(7);
  for (int i = 0; i < 70000; ++i) {
    const uint32_t draw = rng.Below(7);
    ASSERT_LT(draw, 7u);
    ++count[draw];
  }
  for (const int c : count) EXPECT_NEAR(c, 10000, 500) << "five standard deviations";
}

TEST(Rng, UniformStaysInsideAndCentred) {
  Rng rng(5);
  double sum = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = rng.Uniform(-3, 5);
    ASSERT_TRUE(x >= -3 && x < 5);
    sum += x;
  }
  EXPECT_NEAR(sum / 100000, 1, 0.04);
}

TEST(Rng, GaussianHasItsMomentsAndTails) {
  Rng rng(6);
  constexpr int kCount = 200000;
  double sum = 0, sum2 = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = rng.Gaussian();
    ASSERT_TRUE(std::isfinite(x));
    sum += x;
    sum2 += x * x;
    beyond_two += std::abs(x) > 2;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.012);
  EXPECT_NEAR(sum2 / kCount, 1, 0.017);
  EXPECT_NEAR(beyond_two / double{kCount}, 0.0455, 0.0025);
}

}  // namespace
}  // namespace orbslam::test
