// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/point_counter.h"

#include <gmock/gmock.h>

#include <map>

#include "orbslam/util/random.h"

namespace orbslam::test {
namespace {

TEST(PointCounter, SumsEqualAPlainMapsAndStartAgainAfterTaking) {
  Rng rng(24);
  PointCounter counter;
  for (int round = 0; round < 5; ++round) {
    std::map<MapPointId, std::pair<int, int>> expected;
    for (int i = 0; i < 2000; ++i) {
      const MapPointId id(rng.Below(100) * rng.Below(100));
      if (rng.Below(3) == 0) {
        counter.CountFound(id);
        ++expected[id].second;
      } else {
        counter.CountVisible(id);
        ++expected[id].first;
      }
    }
    const std::vector<PointStatistics> taken = counter.Take();
    ASSERT_EQ(taken.size(), expected.size());
    auto it = expected.begin();
    for (const PointStatistics& s : taken) {
      EXPECT_EQ(s.point, it->first) << "ascending in id";
      EXPECT_EQ(s.times_visible, it->second.first);
      EXPECT_EQ(s.times_found, it->second.second);
      ++it;
    }
  }
}

TEST(PointCounter, NothingCountedNothingTaken) {
  PointCounter counter;
  counter.CountVisible(MapPointId(0));
  EXPECT_THAT(counter.Take(), testing::SizeIs(1));
  EXPECT_THAT(counter.Take(), testing::IsEmpty());
}

}  // namespace
}  // namespace orbslam::test
