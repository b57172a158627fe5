// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/mailbox.h"

#include <gmock/gmock.h>

#include <chrono>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

namespace orbslam {
namespace {

using ::testing::Optional;
using ::testing::Pointee;
using Clock = std::chrono::steady_clock;
using std::chrono::hours;
using std::chrono::milliseconds;

TEST(MailboxTest, HoldsTheNewestValueOnce) {
  Mailbox<std::unique_ptr<int>> mailbox;
  EXPECT_EQ(mailbox.TryTake(), std::nullopt);
  for (int i = 0; i < 5; ++i) mailbox.Put(std::make_unique<int>(i));
  EXPECT_THAT(mailbox.TryTake(), Optional(Pointee(4)));
  EXPECT_EQ(mailbox.TryTake(), std::nullopt);
}

TEST(MailboxTest, AReaderSeesAscendingValuesAndTheLastOne) {
  constexpr int kLast = 20000;
  Mailbox<int> mailbox;
  std::jthread writer([&] {
    for (int i = 1; i <= kLast; ++i) mailbox.Put(i);
    mailbox.Close();
  });
  int previous = 0;
  while (const auto value = mailbox.Take()) {
    EXPECT_GT(*value, previous);
    previous = *value;
  }
  EXPECT_EQ(previous, kLast);
}

TEST(MailboxTest, TheDeadlineEndsTheWait) {
  Mailbox<int> mailbox;
  const auto deadline = Clock::now() + milliseconds(20);
  EXPECT_EQ(mailbox.TakeUntil(deadline), std::nullopt);
  EXPECT_GE(Clock::now(), deadline);
  EXPECT_LT(Clock::now(), deadline + milliseconds(2000));  // generous: the machine may be busy
}

TEST(MailboxTest, AValueEndsTheWaitBeforeTheDeadline) {
  Mailbox<int> mailbox;
  std::jthread writer([&] { mailbox.Put(1); });
  EXPECT_THAT(mailbox.TakeUntil(Clock::now() + hours(1)), Optional(1));
}

TEST(MailboxTest, AValueThatIsThereIsTakenAfterTheDeadline) {
  Mailbox<int> mailbox;
  const auto past = Clock::now() - milliseconds(1);
  mailbox.Put(1);
  EXPECT_THAT(mailbox.TakeUntil(past), Optional(1));
  mailbox.Put(2);
  EXPECT_THAT(mailbox.TakeMatching([](int value) { return value == 2; }, past), Optional(2));
}

TEST(MailboxTest, TakeMatchingWaitsForItsValueAndDiscardsOthers) {
  Mailbox<int> mailbox;
  std::jthread writer([&] {
    for (int i = 0; i <= 1000; ++i) mailbox.Put(i);
  });
  const auto is_last = [](int value) { return value == 1000; };
  EXPECT_THAT(mailbox.TakeMatching(is_last, Clock::now() + hours(1)), Optional(1000));
  mailbox.Put(1);
  EXPECT_EQ(mailbox.TakeMatching(is_last, Clock::now() + milliseconds(5)), std::nullopt);
  EXPECT_EQ(mailbox.TryTake(), std::nullopt);
}

TEST(MailboxTest, TakeMatchingEndsAtTheDeadlineThoughOthersKeepComing) {
  Mailbox<int> mailbox;
  const auto deadline = Clock::now() + milliseconds(5);
  const auto refill = [&](int) {
    mailbox.Put(0);
    return false;
  };
  mailbox.Put(0);
  EXPECT_EQ(mailbox.TakeMatching(refill, deadline), std::nullopt);
  EXPECT_GE(Clock::now(), deadline);
}

TEST(MailboxTest, AfterCloseNothingIsStoredAndTheLastValueCanBeTaken) {
  Mailbox<int> mailbox;
  mailbox.Put(1);
  mailbox.Close();
  EXPECT_TRUE(mailbox.IsClosed());
  mailbox.Put(2);
  EXPECT_THAT(mailbox.Take(), Optional(1));
  EXPECT_EQ(mailbox.Take(), std::nullopt);
}

TEST(MailboxTest, CloseWakesEveryWaiter) {
  for (int round = 0; round < 200; ++round) {
    Mailbox<int> mailbox;
    const auto deadline = Clock::now() + hours(1);
    std::latch about_to_wait(4);
    std::vector<std::jthread> waiters;
    const auto start = [&](auto wait) {
      waiters.emplace_back([&, wait] {
        about_to_wait.count_down();
        EXPECT_EQ(wait(), std::nullopt);
      });
    };
    start([&] { return mailbox.Take(); });
    start([&] { return mailbox.TakeUntil(deadline); });
    start([&] { return mailbox.TakeMatching([](int) { return true; }, deadline); });
    about_to_wait.arrive_and_wait();
    mailbox.Close();
  }
}

}  // namespace
}  // namespace orbslam
