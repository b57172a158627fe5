// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/bounded_queue.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

namespace orbslam {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

template <class T>
std::vector<T> Drain(BoundedQueue<T>* queue) {
  std::vector<T> items;
  while (auto item = queue->Pop()) items.push_back(std::move(*item));
  return items;
}

TEST(BoundedQueueTest, ManyThreadsLoseNothingDuplicateNothingAndKeepEachProducersOrder) {
  constexpr int kProducers = 4, kConsumers = 3, kItems = 2000;
  constexpr size_t kCapacity = 5;
  BoundedQueue<std::pair<int, int>> queue(kCapacity);
  std::vector<std::vector<std::pair<int, int>>> received(kConsumers);
  std::atomic<size_t> largest_size = 0;
  {
    std::vector<std::jthread> consumers, producers;
    for (auto& items : received) consumers.emplace_back([&] { items = Drain(&queue); });
    for (int producer = 0; producer < kProducers; ++producer) {
      producers.emplace_back([&, producer] {
        for (int i = 0; i < kItems; ++i) {
          EXPECT_TRUE(queue.Push({producer, i}));
          if (const size_t size = queue.size(); size > largest_size) largest_size = size;
        }
      });
    }
    producers.clear();  // joins
    queue.Close();
  }
  EXPECT_LE(largest_size, kCapacity);

  std::vector<std::pair<int, int>> all, expected;
  for (const auto& items : received) {
    std::vector<int> last(kProducers, -1);
    for (const auto& [producer, i] : items) {
      EXPECT_GT(i, last[producer]);
      last[producer] = i;
    }
    all.insert(all.end(), items.begin(), items.end());
  }
  for (int producer = 0; producer < kProducers; ++producer) {
    for (int i = 0; i < kItems; ++i) expected.emplace_back(producer, i);
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, expected);
}

TEST(BoundedQueueTest, AFullQueueMakesPushWaitForPop) {
  for (int round = 0; round < 200; ++round) {
    BoundedQueue<int> queue(1);
    queue.Push(0);
    std::atomic<bool> popping = false;
    std::jthread pusher([&] {
      EXPECT_TRUE(queue.Push(1));
      EXPECT_TRUE(popping);
    });
    std::this_thread::yield();
    popping = true;
    EXPECT_THAT(queue.Pop(), Optional(0));
    EXPECT_THAT(queue.Pop(), Optional(1));
  }
}

TEST(BoundedQueueTest, TryPushTakesCapacityItemsAndLeavesTheNextUntouched) {
  BoundedQueue<std::unique_ptr<int>> queue(3);
  auto item = std::make_unique<int>(7);
  for (size_t i = 0; i < queue.capacity(); ++i) {
    auto fitting = std::make_unique<int>(0);
    EXPECT_TRUE(queue.TryPush(fitting));
    EXPECT_EQ(fitting, nullptr);
  }
  EXPECT_FALSE(queue.TryPush(item));
  ASSERT_NE(item, nullptr);
  queue.Close();
  queue.Pop();
  EXPECT_FALSE(queue.TryPush(item));
  ASSERT_NE(item, nullptr);
}

TEST(BoundedQueueTest, PushDropOldestKeepsTheNewestAndCountsTheLost) {
  BoundedQueue<int> queue(3);
  size_t dropped = 0;
  for (int i = 0; i < 10; ++i) dropped += queue.PushDropOldest(i);
  EXPECT_EQ(dropped, 7u);
  queue.Close();
  EXPECT_EQ(queue.PushDropOldest(10), 1u);
  EXPECT_THAT(Drain(&queue), ElementsAre(7, 8, 9));
}

TEST(BoundedQueueTest, AfterCloseNothingEntersAndWhatIsInsideDrains) {
  BoundedQueue<int> queue(3);
  queue.Push(1);
  queue.Push(2);
  EXPECT_FALSE(queue.IsClosed());
  queue.Close();
  queue.Close();
  EXPECT_TRUE(queue.IsClosed());
  EXPECT_FALSE(queue.Push(3));
  EXPECT_THAT(Drain(&queue), ElementsAre(1, 2));
  EXPECT_EQ(queue.Pop(), std::nullopt);
}

TEST(BoundedQueueTest, CloseWakesEveryWaiter) {
  for (int round = 0; round < 200; ++round) {
    BoundedQueue<int> full(1), empty(1);
    full.Push(0);
    std::latch about_to_wait(5);
    std::vector<std::jthread> waiters;
    for (int i = 0; i < 2; ++i) {
      waiters.emplace_back([&] {
        about_to_wait.count_down();
        EXPECT_FALSE(full.Push(1));
      });
      waiters.emplace_back([&] {
        about_to_wait.count_down();
        EXPECT_EQ(empty.Pop(), std::nullopt);
      });
    }
    about_to_wait.arrive_and_wait();
    full.Close();
    empty.Close();
  }
}

}  // namespace
}  // namespace orbslam
