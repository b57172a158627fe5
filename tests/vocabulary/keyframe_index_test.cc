// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/keyframe_index.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "vocabulary/random_vocabulary.h"

namespace orbslam {
namespace {

using Candidate = KeyFrameIndex::Candidate;

BowVector RandomBow(Rng* rng) {
  BowVector bow;
  for (WordId word = 0; word < 60; ++word) {
    if (rng->Below(4) == 0) bow.push_back({word, static_cast<float>(rng->Uniform(0.1, 1))});
  }
  float sum = 0;
  for (const BowEntry& entry : bow) sum += entry.weight;
  for (BowEntry& entry : bow) entry.weight /= sum;
  return bow;
}

int CommonWords(const BowVector& a, const BowVector& b) {
  return static_cast<int>(std::ranges::count_if(
      a, [&](const BowEntry& entry) { return std::ranges::count(b, entry.word, &BowEntry::word) > 0; }));
}

std::vector<Candidate> BruteForceQuery(const std::map<KeyFrameId, BowVector>& keyframes,
                                       const BowVector& query, const std::vector<KeyFrameId>& excluded,
                                       double ratio) {
  std::vector<Candidate> all;
  int most = 0;
  for (const auto& [id, bow] : keyframes) {
    if (std::ranges::count(excluded, id) > 0) continue;
    all.push_back({id, CommonWords(query, bow), Score(query, bow)});
    most = std::max(most, all.back().common_words);
  }
  std::erase_if(all,
                [&](const Candidate& c) { return c.common_words == 0 || c.common_words < ratio * most; });
  std::ranges::stable_sort(all, std::greater{}, &Candidate::score);
  return all;
}

TEST(KeyFrameIndexTest, AnswersAsBruteForceThroughRandomEdits) {
  Rng rng(1);
  KeyFrameIndex index;
  std::map<KeyFrameId, BowVector> keyframes;
  for (uint32_t step = 0; step < 400; ++step) {
    const KeyFrameId id(step);
    keyframes[id] = RandomBow(&rng);
    index.Add(id, keyframes[id]);
    if (rng.Below(3) > 0) {
      const KeyFrameId victim(rng.Below(step + 1));  // perhaps one that has gone
      keyframes.erase(victim);
      index.Remove(victim);
    }
    ASSERT_EQ(index.size(), keyframes.size());
    const std::vector<KeyFrameId> excluded{KeyFrameId(rng.Below(step + 1)), id};
    const BowVector query = RandomBow(&rng);
    const double ratio = rng.Uniform(0, 1);
    EXPECT_EQ(index.Query(query, excluded, ratio), BruteForceQuery(keyframes, query, excluded, ratio));
  }
}

TEST(KeyFrameIndexTest, FindsItselfFirst) {
  Rng rng(2);
  KeyFrameIndex index;
  std::vector<BowVector> bows;
  for (uint32_t i = 0; i < 20; ++i) index.Add(KeyFrameId(i), bows.emplace_back(RandomBow(&rng)));
  for (uint32_t i = 0; i < 20; ++i) {
    const std::vector<Candidate> candidates = index.Query(bows[i]);
    ASSERT_FALSE(candidates.empty());
    EXPECT_EQ(candidates.front().id, KeyFrameId(i));
    EXPECT_NEAR(candidates.front().score, 1, 1e-5);
  }
}

TEST(KeyFrameIndexTest, TiesGoToTheOlderKeyFrame) {
  KeyFrameIndex index;
  const BowVector bow{{3, 1.0F}};
  for (const uint32_t id : {7, 2, 5}) index.Add(KeyFrameId(id), bow);
  const std::vector<Candidate> expected{{KeyFrameId(2), 1, 1}, {KeyFrameId(5), 1, 1}, {KeyFrameId(7), 1, 1}};
  EXPECT_EQ(index.Query(bow), expected);
}

TEST(KeyFrameIndexTest, NothingSharedGivesNothing) {
  KeyFrameIndex index;
  EXPECT_TRUE(index.Query({{1, 1.0F}}).empty());
  index.Add(KeyFrameId(0), {{2, 1.0F}});
  EXPECT_TRUE(index.Query({{1, 1.0F}}).empty());
  EXPECT_TRUE(index.Query({}).empty());
  index.Remove(KeyFrameId(0));
  EXPECT_TRUE(index.Query({{2, 1.0F}}).empty());
}

}  // namespace
}  // namespace orbslam
