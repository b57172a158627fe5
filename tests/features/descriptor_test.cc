// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/descriptor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

// Few differing bits, so that equal distances (ties) are common.
std::vector<Descriptor> RandomDescriptors(int count, Rng* rng) {
  std::vector<Descriptor> set(count);
  for (auto& descriptor : set) {
    for (int i = 0; i < 12; ++i) descriptor.words[rng->Below(4)] ^= uint64_t{1} << rng->Below(64);
  }
  return set;
}

int NaiveDistance(const Descriptor& a, const Descriptor& b) {
  int bits = 0;
  for (int i = 0; i < 256; ++i) bits += static_cast<int>((a.words[i / 64] ^ b.words[i / 64]) >> (i % 64) & 1);
  return bits;
}

TEST(Descriptor, DistanceCountsDifferentBits) {
  Rng rng(1);
  Descriptor zeros, ones;
  ones.words.fill(~uint64_t{0});
  EXPECT_EQ(HammingDistance(zeros, ones), 256);
  for (int i = 0; i < 200; ++i) {
    Descriptor a, b;
    for (auto* d : {&a, &b}) std::generate(d->words.begin(), d->words.end(), std::ref(rng));
    EXPECT_EQ(HammingDistance(a, b), NaiveDistance(a, b));
    EXPECT_EQ(HammingDistance(a, b), HammingDistance(b, a));
    EXPECT_EQ(HammingDistance(a, a), 0);
  }
}

TEST(Descriptor, NearestTwoAreTheFirstOfAStableSort) {
  Rng rng(2);
  for (int trial = 0; trial < 50; ++trial) {
    const auto database = RandomDescriptors(40, &rng);
    const auto query = database[rng.Below(40)];
    std::vector<int> order;
    for (int i = 0; i < 30; ++i) order.push_back(static_cast<int>(rng.Below(40)));
    std::sort(order.begin(), order.end());
    order.erase(std::unique(order.begin(), order.end()), order.end());
    const NearestTwo found = FindNearestTwo(query, database, order);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return NaiveDistance(query, database[a]) < NaiveDistance(query, database[b]);
    });
    EXPECT_EQ(found.index, order[0]);
    EXPECT_EQ(found.second_index, order[1]);
    EXPECT_EQ(found.distance, NaiveDistance(query, database[order[0]]));
    EXPECT_EQ(found.second_distance, NaiveDistance(query, database[order[1]]));
  }
}

TEST(Descriptor, NearestTwoOfAllEqualsNearestTwoOfEveryIndex) {
  Rng rng(3);
  const auto database = RandomDescriptors(100, &rng);
  std::vector<int> all(database.size());
  std::iota(all.begin(), all.end(), 0);
  const NearestTwo a = FindNearestTwo(database[7], database), b = FindNearestTwo(database[7], database, all);
  EXPECT_EQ(a.distance, 0);
  EXPECT_EQ(std::tie(a.index, a.distance, a.second_index, a.second_distance),
            std::tie(b.index, b.distance, b.second_index, b.second_distance));
}

TEST(Descriptor, NearestTwoOfFewerThanTwo) {
  const std::vector<Descriptor> one(1);
  EXPECT_EQ(FindNearestTwo(one[0], one).index, 0);
  EXPECT_EQ(FindNearestTwo(one[0], one).second_index, -1);
  EXPECT_EQ(FindNearestTwo(one[0], {}).index, -1);
}

TEST(Descriptor, MedoidHasTheFirstLeastMedianDistanceToTheOthers) {
  Rng rng(4);
  for (int size = 1; size < 30; ++size) {
    const auto set = RandomDescriptors(size, &rng);
    std::vector<int> medians;
    for (int i = 0; i < size; ++i) {
      std::vector<int> distances;
      for (int j = 0; j < size; ++j) {
        if (j != i) distances.push_back(NaiveDistance(set[i], set[j]));
      }
      std::sort(distances.begin(), distances.end());
      medians.push_back(distances.empty() ? 0 : distances[(distances.size() - 1) / 2]);
    }
    EXPECT_EQ(MedoidIndex(set), std::min_element(medians.begin(), medians.end()) - medians.begin());
  }
}

}  // namespace
}  // namespace orbslam
