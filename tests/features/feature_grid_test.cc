// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/feature_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

using ::testing::UnorderedElementsAreArray;

struct Points {
  std::vector<cv::Point2f> pixels;
  std::vector<int> levels;
};

// Some lie outside the bounds, as undistorted pixels may.
Points RandomPoints(int count, const ImageBounds& bounds, Rng* rng) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.pixels.emplace_back(static_cast<float>(rng->Uniform(bounds.min_u - 20, bounds.max_u + 20)),
                               static_cast<float>(rng->Uniform(bounds.min_v - 20, bounds.max_v + 20)));
    points.levels.push_back(static_cast<int>(rng->Below(8)));
  }
  return points;
}

TEST(FeatureGrid, FindsExactlyWhatASearchThroughAllFinds) {
  Rng rng(1);
  const ImageBounds bounds{-12.5f, -7.0f, 655.0f, 488.0f};
  const Points points = RandomPoints(1000, bounds, &rng);
  const FeatureGrid grid(points.pixels, bounds);
  std::vector<int> found;
  for (int trial = 0; trial < 500; ++trial) {
    const auto u = static_cast<float>(rng.Uniform(-60, 700)), v = static_cast<float>(rng.Uniform(-60, 540));
    const auto radius = static_cast<float>(rng.Uniform(0, trial % 5 == 0 ? 900 : 60));
    const int min_level = static_cast<int>(rng.Below(8)),
              max_level = min_level + static_cast<int>(rng.Below(3));
    std::vector<int> expected;
    for (int i = 0; i < 1000; ++i) {
      const bool level_fits = points.levels[i] >= min_level && points.levels[i] <= max_level;
      const float du = std::abs(points.pixels[i].x - u), dv = std::abs(points.pixels[i].y - v);
      if (level_fits && du < radius && dv < radius) expected.push_back(i);
    }
    grid.Near(u, v, radius, points.pixels, points.levels, min_level, max_level, &found);
    EXPECT_THAT(found, UnorderedElementsAreArray(expected));
  }
}

TEST(FeatureGrid, NothingIsNearNowhere) {
  std::vector<int> found = {1, 2, 3};
  FeatureGrid().Near(10, 10, 100, {}, {}, 0, 7, &found);
  EXPECT_TRUE(found.empty());
  Rng rng(2);
  const ImageBounds bounds{0, 0, 640, 480};
  const Points points = RandomPoints(10, bounds, &rng);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  FeatureGrid(points.pixels, bounds).Near(nan, nan, 100, points.pixels, points.levels, 0, 7, &found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace orbslam
