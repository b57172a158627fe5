// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace orbslam::test {
namespace {

Result<int> Half(int n) {
  if (n % 2 != 0) return Error{"odd"};
  return n / 2;
}

TEST(Result, HoldsAValueOrAnErrorAndNeverBoth) {
  const Result<int> good = Half(8), bad = Half(7);
  ASSERT_TRUE(good.ok() && good);
  EXPECT_EQ(*good, 4);
  ASSERT_FALSE(bad.ok() || bad);
  EXPECT_EQ(bad.error().message, "odd");
}

TEST(Result, GivesAwayWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(3));
  EXPECT_EQ(**result, 3);
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 3);
}

TEST(Result, StringValueIsNoError) {
  const Result<std::string> result(std::string("fine"));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->size(), 4u);
}

TEST(Status, IsOkOrExplains) {
  EXPECT_TRUE(OkStatus().ok());
  EXPECT_FALSE(Status(Error{"disk full"}).ok());
}

TEST(ResultDeathTest, UsingTheWrongSideIsABug) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH((void)Half(7).value(), "ok\\(\\)");
  EXPECT_DEATH((void)Half(8).error(), "!ok\\(\\)");
}

}  // namespace
}  // namespace orbslam::test
