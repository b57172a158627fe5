// SPDX-License-Identifier: GPL-3.0-or-later
#include "mover_presence.h"

#include <gtest/gtest.h>

#include <vector>

namespace orbslam {
namespace {

constexpr int kImagePixels = 640 * 480;
constexpr int kSmall = kImagePixels / 100, kLarge = kImagePixels / 20;
constexpr double kUnsure = 0.5, kSure = 3;
constexpr double kFrameS = 1 / 30.0;

class MoverPresenceTest : public testing::Test {
 protected:
  struct Thing {
    int id = 1;
    int num_pixels = kSmall;
    double log_odds = kUnsure;
  };
  bool Show(const std::vector<Thing>& things) {
    std::vector<DynamicObject> objects;
    for (const Thing& thing : things) {
      DynamicObject& object = objects.emplace_back();
      object.id = thing.id, object.num_pixels = thing.num_pixels, object.log_odds = thing.log_odds;
    }
    return presence_.Update(objects, kImagePixels, kFrameS * num_shown_++);
  }
  /// Frames until something is believed to move; -1: never.
  int FramesToBelief(const std::vector<Thing>& things, int num_frames) {
    for (int i = 0; i < num_frames; ++i)
      if (Show(things)) return i;
    return -1;
  }
  void Rest(double time_s) {
    for (int i = 0; i < time_s / kFrameS; ++i) Show({});
  }

  const PresenceOptions options_;
  MoverPresence presence_{options_};
  int num_shown_ = 0;
};

TEST_F(MoverPresenceTest, WhatIsLargeOrCertainIsBelievedAtOnce) {
  EXPECT_FALSE(Show({{.num_pixels = kSmall}}));
  EXPECT_TRUE(Show({{.num_pixels = kLarge}}));
  Rest(2 * options_.memory_s);
  EXPECT_FALSE(Show({{.log_odds = kUnsure}}));
  EXPECT_TRUE(Show({{.log_odds = kSure}}));
}

TEST_F(MoverPresenceTest, WhatIsNeitherIsBelievedOnceItLasts) {
  EXPECT_NEAR(FramesToBelief({{.id = 7}}, 100) * kFrameS, options_.min_age_s, 1.5 * kFrameS);
}

TEST_F(MoverPresenceTest, ShortErrorsOneAfterAnotherAreNotBelieved) {
  for (int id = 1; id <= 20; ++id)
    EXPECT_EQ(FramesToBelief({{.id = id}}, static_cast<int>(0.5 / kFrameS)), -1) << id;
}

TEST_F(MoverPresenceTest, AnIdThatWasAwayBeginsAnew) {
  const int most = static_cast<int>(0.8 / kFrameS);
  EXPECT_EQ(FramesToBelief({{.id = 3}}, most), -1);
  Show({});
  EXPECT_EQ(FramesToBelief({{.id = 3}}, most), -1);
}

TEST_F(MoverPresenceTest, WhereOneMovesSmallThingsAreBelievedForAWhile) {
  Show({{.id = 1, .num_pixels = kLarge}});
  EXPECT_TRUE(Show({{.id = 2}}));
  Rest(0.9 * options_.memory_s);
  EXPECT_TRUE(Show({{.id = 3}}));
  Rest(0.3 * options_.memory_s);
  EXPECT_FALSE(Show({{.id = 4}})) << "the memory has faded";
}

TEST_F(MoverPresenceTest, SwitchedOffEverythingIsBelieved) {
  MoverPresence off({.use_presence = false});
  EXPECT_TRUE(off.Update({}, kImagePixels, 0));
}

}  // namespace
}  // namespace orbslam
