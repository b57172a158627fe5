// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/stage_timer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "orbslam/util/random.h"

namespace orbslam::test {
namespace {

/// Fraction of values that are not above x.
double FractionUpTo(double x, const std::vector<double>& values) {
  int count = 0;
  for (const double v : values) count += v <= x;
  return count / static_cast<double>(values.size());
}

TEST(StageTimer, PercentileIsTheLeastMeasuredValueThatEnoughDoNotExceed) {
  Rng rng(7);
  for (const int count : {1, 2, 3, 9, 10, 11, 99, 100, 101, 1000}) {
    StageTimer timer;
    std::vector<double> values;
    for (int i = 0; i < count; ++i) timer.Add("step", values.emplace_back(rng.Uniform()));
    const StageTimer::Statistics s = timer.Summarize().at("step");
    EXPECT_EQ(s.count, count);
    for (const auto& [percentile, fraction] :
         {std::pair{s.median_s, 0.5}, {s.p90_s, 0.9}, {s.p99_s, 0.99}, {s.max_s, 1.0}}) {
      EXPECT_GE(FractionUpTo(percentile, values), fraction) << count;
      EXPECT_LT(FractionUpTo(std::nextafter(percentile, 0.0), values), fraction) << count;
    }
  }
}

TEST(StageTimer, KeepsNamesApart) {
  StageTimer timer;
  timer.Add("a", 1);
  timer.Add("b", 10);
  timer.Add("a", 3);
  const auto summary = timer.Summarize();
  ASSERT_EQ(summary.size(), 2u);
  EXPECT_DOUBLE_EQ(summary.at("a").mean_s, 2);
  EXPECT_DOUBLE_EQ(summary.at("b").mean_s, 10);
}

TEST(StageTimer, NothingMeasuredNothingSaid) { EXPECT_TRUE(StageTimer().Summarize().empty()); }

TEST(StageTimer, ScopeMeasuresWallTimeUntilItsEnd) {
  using Clock = std::chrono::steady_clock;
  StageTimer timer;
  const Clock::time_point before = Clock::now();
  {
    const auto measure = timer.Measure("step");
    EXPECT_TRUE(timer.Summarize().empty()) << "not over yet";
    const Clock::time_point inside = Clock::now();
    while (Clock::now() - inside < std::chrono::milliseconds(2)) {
    }
  }
  const double outside_s = std::chrono::duration<double>(Clock::now() - before).count();
  const StageTimer::Statistics s = timer.Summarize().at("step");
  EXPECT_GE(s.mean_s, 0.002);
  EXPECT_LE(s.mean_s, outside_s);
}

}  // namespace
}  // namespace orbslam::test
