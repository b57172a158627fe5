// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/orientation_check.h"

#include <gmock/gmock.h>

#include <cmath>

#include "orbslam/util/random.h"

namespace orbslam::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;

/// Angles a whole number of degrees and a half apart: off the borders of the bins, whatever the rounding.
float Angle(Rng* rng) { return static_cast<float>(rng->Below(360)); }
float Plus(float angle_deg, float turn_deg) { return std::fmod(angle_deg + turn_deg, 360.0f); }

TEST(OrientationCheck, KeepsAllThatTurnAlikeWhateverTheirAngles) {
  Rng rng(1);
  for (float turn_deg = 0.5f; turn_deg < 360; turn_deg += 7) {
    OrientationCheck check;
    for (int i = 0; i < 50; ++i) {
      const float from_deg = Angle(&rng);
      check.Add(i, from_deg, Plus(from_deg, turn_deg));
    }
    EXPECT_THAT(check.Outliers(), IsEmpty()) << turn_deg;
  }
}

TEST(OrientationCheck, RemovesTheFewThatTurnOtherwise) {
  Rng rng(2);
  for (float turn_deg = 0.5f; turn_deg < 360; turn_deg += 7) {
    OrientationCheck check;
    std::vector<int> odd;
    for (int i = 0; i < 200; ++i) {
      const bool is_odd = i % 20 == 0;
      if (is_odd) odd.push_back(i);
      const float from_deg = Angle(&rng);
      check.Add(i, from_deg, Plus(from_deg, turn_deg + (is_odd ? 30 + static_cast<float>(i) : 0)));
    }
    EXPECT_THAT(check.Outliers(), UnorderedElementsAreArray(odd)) << turn_deg;
  }
}

TEST(OrientationCheck, FourthFullestBinLoses) {
  OrientationCheck check;
  int match = 0;
  for (const int bin : {0, 5, 10, 15}) {
    for (int i = 0; i < 20 - bin; ++i) check.Add(match++, 0, 12.0f * static_cast<float>(bin) + 6);
  }
  EXPECT_THAT(check.Outliers(), ElementsAre(45, 46, 47, 48, 49));
}

TEST(OrientationCheck, TurnsThatRoundToAWholeCircleAreNone) {
  OrientationCheck check;
  check.Add(0, 1e-7f, 0);
  check.Add(1, 0, 0);
  EXPECT_THAT(check.Outliers(), IsEmpty());
}

TEST(OrientationCheck, NothingAddedNothingOdd) { EXPECT_THAT(OrientationCheck().Outliers(), IsEmpty()); }

}  // namespace
}  // namespace orbslam::test
