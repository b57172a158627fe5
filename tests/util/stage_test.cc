// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/stage.h"

#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <latch>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace orbslam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StageModeTest : public ::testing::TestWithParam<StageMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, StageModeTest, ::testing::Values(StageMode::kThreaded, StageMode::kInline));

TEST_P(StageModeTest, HandlesAllInOrderBeforeJoin) {
  std::vector<int> handled, expected(1000);
  std::iota(expected.begin(), expected.end(), 0);
  Stage<std::unique_ptr<int>> stage(
      "order", 3, [&](std::unique_ptr<int> message) { handled.push_back(*message); }, GetParam());
  stage.Start();
  for (const int i : expected) EXPECT_TRUE(stage.Push(std::make_unique<int>(i)));
  stage.CloseAndJoin();
  stage.CloseAndJoin();
  EXPECT_EQ(handled, expected);
  EXPECT_FALSE(stage.Push(std::make_unique<int>(0)));
  auto late = std::make_unique<int>(0);
  EXPECT_FALSE(stage.TryPush(late));
  EXPECT_NE(late, nullptr);
  EXPECT_FALSE(stage.failure());
}

TEST_P(StageModeTest, AnExceptionIsReportedAndNothingRunsAfterIt) {
  std::vector<int> handled;
  Stage<int> stage(
      "solver", 2,
      [&](int message) {
        handled.push_back(message);
        if (message == 2) throw std::runtime_error("singular");
      },
      GetParam());
  stage.Start();
  int pushed = 0;
  while (stage.Push(pushed)) ++pushed;  // ends because the failure closes the stage
  EXPECT_GE(pushed, 3);
  stage.WaitUntilIdle();
  EXPECT_TRUE(stage.IsIdle());
  EXPECT_THAT(handled, ElementsAre(0, 1, 2));
  ASSERT_TRUE(stage.failure());
  EXPECT_THAT(stage.failure()->message, HasSubstr("solver: singular"));
}

TEST_P(StageModeTest, AnythingThrownIsContained) {
  Stage<int> stage(
      "odd", 1, [](int) { throw 42; }, GetParam());
  stage.Start();
  stage.Push(0);
  stage.CloseAndJoin();
  EXPECT_TRUE(stage.failure());
}

TEST_P(StageModeTest, CountsTheHandlersCpuTime) {
  constexpr double kBurn_s = 0.005;
  const auto burn = [](int) {
    const CpuStopwatch stopwatch;
    while (stopwatch.CpuSeconds() < kBurn_s) {
    }
  };
  Stage<int> stage("burner", 4, burn, GetParam());
  const double process_start_s = ProcessCpuSeconds();
  stage.Start();
  EXPECT_EQ(stage.CpuSeconds(), 0.0);
  for (int i = 1; i <= 4; ++i) {
    stage.Push(i);
    stage.WaitUntilIdle();
    EXPECT_GE(stage.CpuSeconds(), i * kBurn_s);
  }
  EXPECT_LE(stage.CpuSeconds(), ProcessCpuSeconds() - process_start_s);
}

TEST(StageTest, InlineRunsOnTheCallersThreadAndIsAlwaysIdle) {
  std::thread::id handled_on;
  Stage<int> stage(
      "inline", 1, [&](int) { handled_on = std::this_thread::get_id(); }, StageMode::kInline);
  int message = 0;
  EXPECT_TRUE(stage.TryPush(message));
  EXPECT_EQ(handled_on, std::this_thread::get_id());
  EXPECT_TRUE(stage.IsIdle());
  EXPECT_EQ(stage.QueueSize(), 0u);
}

TEST(StageTest, TheThreadCarriesTheFirst15CharactersOfTheName) {
  std::array<char, 16> name{};
  Stage<int> stage("local_mapping_thread", 1,
                   [&](int) { pthread_getname_np(pthread_self(), name.data(), name.size()); });
  stage.Start();
  stage.Push(0);
  stage.WaitUntilIdle();
  EXPECT_STREQ(name.data(), "local_mapping_t");
}

TEST(StageTest, IsNeverIdleWhileAMessageIsQueuedOrHandled) {
  std::atomic<int> handled = 0;
  Stage<int> stage("gapless", 2, [&](int) { ++handled; });
  stage.Start();
  for (int pushed = 1; pushed <= 5000; ++pushed) {
    stage.Push(pushed);
    while (!stage.IsIdle()) std::this_thread::yield();
    ASSERT_EQ(handled, pushed);
  }
}

TEST(StageTest, WaitUntilIdleReturnsWhenAllIsHandled) {
  int handled = 0;  // not atomic: the wait itself must order the accesses
  Stage<int> stage("waiter", 8, [&](int) { ++handled; });
  stage.Start();
  for (int pushed = 1; pushed <= 3000; ++pushed) {
    stage.Push(pushed);
    if (pushed % 3 != 0) continue;
    stage.WaitUntilIdle();
    ASSERT_EQ(handled, pushed);
  }
}

TEST(StageTest, WaitsForStartAndThenHandlesWhatIsQueued) {
  std::atomic<int> handled = 0;
  Stage<int> stage("late", 2, [&](int) { ++handled; });
  int message = 0;
  EXPECT_TRUE(stage.TryPush(message));
  EXPECT_TRUE(stage.TryPush(message));
  EXPECT_FALSE(stage.TryPush(message));
  EXPECT_EQ(stage.QueueSize(), 2u);
  EXPECT_FALSE(stage.IsIdle());
  EXPECT_EQ(handled, 0);
  stage.Start();
  stage.Start();
  stage.WaitUntilIdle();
  EXPECT_EQ(handled, 2);
}

TEST(StageTest, ClosingAStageThatNeverStartedLetsEveryoneGo) {
  Stage<int> stage("never", 1, [](int) { FAIL() << "handled without a start"; });
  stage.Push(0);
  std::jthread pusher([&] { EXPECT_FALSE(stage.Push(1)); });
  std::jthread waiter([&] { stage.WaitUntilIdle(); });
  stage.CloseAndJoin();
  stage.Start();
  stage.WaitUntilIdle();
}

TEST(StageTest, StartAndStopWhilePushingHandlesExactlyWhatWasAccepted) {
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> accepted = 0, handled = 0;
    {
      Stage<int> stage("restless", 2, [&](int) { ++handled; });
      std::latch pushing(3);
      const auto push_until_closed = [&] {
        pushing.count_down();
        while (stage.Push(0)) ++accepted;
      };
      std::jthread first(push_until_closed), second(push_until_closed);
      stage.Start();
      pushing.arrive_and_wait();
      stage.CloseAndJoin();
    }
    EXPECT_EQ(handled, accepted);
  }
}

}  // namespace
}  // namespace orbslam
