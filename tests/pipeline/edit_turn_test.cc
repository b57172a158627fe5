// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/edit_turn.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <latch>
#include <thread>
#include <vector>

namespace orbslam {
namespace {

/// Waits until the holder is asked to yield; false: nobody does.
bool IsAsked(const EditTurn::Holder& held) {
  std::promise<void> asked;
  const std::stop_callback callback(held.ShouldYield(), [&asked] { asked.set_value(); });
  return asked.get_future().wait_for(std::chrono::seconds(10)) == std::future_status::ready;
}

TEST(EditTurn, OnlyOneHoldsIt) {
  constexpr int kTurns = 500;
  EditTurn turn;
  int num_inside = 0, num_turns = 0;  // plain: the turn alone guards them
  {
    std::vector<std::jthread> editors;
    for (int i = 0; i < 4; ++i) {
      editors.emplace_back([&] {
        for (int k = 0; k < kTurns; ++k) {
          const auto held = turn.Take();
          EXPECT_EQ(++num_inside, 1);
          ++num_turns;
          --num_inside;
        }
      });
    }
  }
  EXPECT_EQ(num_turns, 4 * kTurns);
}

TEST(EditTurn, WhoWaitsAsksTheHolderToYield) {
  EditTurn turn;
  std::jthread waiter;
  {
    const auto held = turn.Take();
    EXPECT_FALSE(held.ShouldYield().stop_requested());
    waiter = std::jthread([&] { const auto next = turn.Take(); });
    EXPECT_TRUE(IsAsked(held));
  }
}

TEST(EditTurn, TheNextHolderIsAskedByThoseWhoStillWait) {
  for (int round = 0; round < 20; ++round) {
    EditTurn turn;
    std::atomic<int> num_waiting = 2;
    std::latch ready(3);
    std::vector<std::jthread> waiters;
    const auto wait = [&] {
      ready.arrive_and_wait();
      const auto held = turn.Take();
      if (--num_waiting > 0) {
        EXPECT_TRUE(IsAsked(held));
      }
    };
    {
      const auto held = turn.Take();
      for (int i = 0; i < 2; ++i) waiters.emplace_back(wait);
      ready.arrive_and_wait();
      ASSERT_TRUE(IsAsked(held));
      for (int i = 0; i < 1000; ++i) std::this_thread::yield();  // so that most often both wait by now
    }
    waiters.clear();
    if (testing::Test::HasFailure()) return;
  }
}

TEST(EditTurn, AskingToYieldReachesTheHolderOfNowOnly) {
  EditTurn turn;
  turn.AskToYield();
  {
    const auto held = turn.Take();
    EXPECT_FALSE(held.ShouldYield().stop_requested());
    turn.AskToYield();
    EXPECT_TRUE(held.ShouldYield().stop_requested());
  }
  EXPECT_FALSE(turn.Take().ShouldYield().stop_requested());
}

}  // namespace
}  // namespace orbslam
