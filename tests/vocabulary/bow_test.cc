// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/bow.h"

#include <gmock/gmock.h>

#include <cmath>

#include "orbslam/vocabulary/vocabulary.h"
#include "vocabulary/random_vocabulary.h"

namespace orbslam {
namespace {

constexpr uint64_t kAll = ~uint64_t{0};

/// Three words: all bits 0 (weight 1), low half set (weight 2), all bits set (weight 0: a stop word).
Vocabulary TinyVocabulary() {
  const Descriptor zeros{}, half{{kAll, kAll, 0, 0}}, ones{{kAll, kAll, kAll, kAll}};
  return Vocabulary::Create({3, 1, {{}, zeros, half, ones}, {3, 0, 0, 0}, {1, 2, 0}}).value();
}

TEST(BowTest, WeightsAreCountsTimesIdfDividedByTheirSum) {
  const Descriptor zeros{}, near_half{{kAll, kAll ^ 5, 2, 0}}, ones{{kAll, kAll, kAll, kAll}};
  const auto [bow, index] = TinyVocabulary().Transform(std::vector{zeros, near_half, ones, zeros, zeros}, 1);
  EXPECT_EQ(bow, (BowVector{{0, 3.0F / 5}, {1, 2.0F / 5}}));  // 3 x 1 and 1 x 2; the stop word is left out
  EXPECT_EQ(index.nodes, (std::vector<NodeId>{1, 2, 3}));
  EXPECT_EQ(index.features, (std::vector{0, 3, 4, 1, 2}));
  EXPECT_THAT(index.FeaturesOf(0), testing::ElementsAre(0, 3, 4));
}

TEST(BowTest, ScoresAreAsComputedByHand) {
  const BowVector a{{0, 0.6F}, {1, 0.4F}}, b{{0, 0.25F}, {2, 0.75F}}, c{{3, 1}};
  EXPECT_FLOAT_EQ(Score(a, b), 1 - 0.5F * (0.35F + 0.4F + 0.75F));
  EXPECT_FLOAT_EQ(Score(a, a), 1);
  EXPECT_EQ(Score(a, c), 0);
  EXPECT_EQ(Score(a, {}), 0);
  EXPECT_EQ(Score({}, {}), 0);
}

TEST(BowTest, ScoreIsOneMinusHalfTheL1Distance) {
  const Vocabulary vocabulary = RandomVocabulary(4, 3, 11);
  Rng rng(12);
  for (int trial = 0; trial < 50; ++trial) {
    const BowVector a = vocabulary.Transform(RandomDescriptors(30, &rng), 1).bow;
    const BowVector b = vocabulary.Transform(RandomDescriptors(50, &rng), 1).bow;
    std::vector<double> difference(vocabulary.num_words());
    for (const BowEntry& entry : a) difference[entry.word] += entry.weight;
    for (const BowEntry& entry : b) difference[entry.word] -= entry.weight;
    double distance = 0;
    for (const double d : difference) distance += std::abs(d);
    EXPECT_NEAR(Score(a, b), 1 - distance / 2, 1e-5);
    EXPECT_EQ(Score(a, b), Score(b, a));
  }
}

}  // namespace
}  // namespace orbslam
