// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/resource_usage.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace orbslam::test {
namespace {

void BurnCpu(double seconds) {
  const double start = ThreadCpuSeconds();
  while (ThreadCpuSeconds() - start < seconds) {
  }
}

TEST(ResourceUsage, CpuTimeOfAnotherThreadCountsForTheProcessOnly) {
  const double process_before = ProcessCpuSeconds();
  const CpuStopwatch stopwatch;
  std::jthread([] { BurnCpu(0.05); }).join();
  EXPECT_GE(ProcessCpuSeconds() - process_before, 0.05);
  EXPECT_LT(stopwatch.CpuSeconds(), 0.04);
  EXPECT_GE(stopwatch.WallSeconds(), 0.05);
}

TEST(ResourceUsage, StopwatchCountsWorkOfItsThread) {
  const CpuStopwatch stopwatch;
  BurnCpu(0.02);
  EXPECT_GE(stopwatch.CpuSeconds(), 0.02);
  EXPECT_GE(stopwatch.WallSeconds(), 0.99 * stopwatch.CpuSeconds());
}

TEST(ResourceUsage, ProcessHasRunAtLeastSinceItFirstSaidSo) {
  const double first = SecondsSinceProcessStart();
  const CpuStopwatch stopwatch;
  BurnCpu(0.02);
  const double passed = SecondsSinceProcessStart() - first;
  EXPECT_GE(first, -0.01) << "to the resolution of 10 ms";
  EXPECT_LT(first, 3600);
  EXPECT_NEAR(passed, stopwatch.WallSeconds(), 0.02);
}

TEST(ResourceUsage, PeakMemoryGrowsWithWhatIsTouchedAndNeverFalls) {
  const double before = PeakMemoryMb();
  EXPECT_GT(before, 1);
  { const std::vector<char> block(200'000'000, 1); }
  const double after = PeakMemoryMb();
  EXPECT_GT(after, 190);
  EXPECT_GE(PeakMemoryMb(), after);
}

}  // namespace
}  // namespace orbslam::test
