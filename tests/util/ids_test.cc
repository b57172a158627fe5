// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/ids.h"

#include <gtest/gtest.h>

#include <concepts>
#include <type_traits>
#include <unordered_set>

namespace orbslam::test {
namespace {

static_assert(!std::is_convertible_v<KeyFrameId, MapPointId> &&
              !std::is_constructible_v<MapPointId, KeyFrameId>);
static_assert(!std::is_convertible_v<uint32_t, FrameId>, "a number becomes an id only when somebody says so");
static_assert(!std::equality_comparable_with<KeyFrameId, MapPointId>);

TEST(StrongId, DefaultNamesNothing) {
  EXPECT_FALSE(FrameId().IsValid());
  EXPECT_TRUE(FrameId(0).IsValid());
  EXPECT_EQ(FrameId(), FrameId(FrameId::kInvalid));
}

TEST(StrongId, OrdersLikeItsNumberWithNothingLast) {
  EXPECT_LT(FrameId(3), FrameId(4));
  EXPECT_EQ(FrameId(4), FrameId(4));
  EXPECT_LT(FrameId(4), FrameId());
}

TEST(StrongId, HashesApart) {
  std::unordered_set<MapPointId> ids;
  for (uint32_t i = 0; i < 1000; ++i) ids.insert(MapPointId(i % 500));
  EXPECT_EQ(ids.size(), 500u);
}

}  // namespace
}  // namespace orbslam::test
