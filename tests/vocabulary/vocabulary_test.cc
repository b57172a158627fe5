// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/vocabulary.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>

#include "vocabulary/random_vocabulary.h"

namespace orbslam {
namespace {

using testing::HasSubstr;

/// Descends by looking at every node, with nothing but the counts of children.
Vocabulary::Place BruteForceFind(const VocabularyTree& tree, const Descriptor& descriptor, int level) {
  const auto is_word = [&](size_t node) { return tree.child_counts[node] == 0; };
  size_t node = 0, ancestor = 0;
  for (int depth = 0; !is_word(node); ++depth) {
    size_t first = 1;
    for (size_t i = 0; i < node; ++i) first += tree.child_counts[i];
    size_t best = first;
    for (size_t child = first; child < first + tree.child_counts[node]; ++child) {
      if (HammingDistance(descriptor, tree.descriptors[child]) <
          HammingDistance(descriptor, tree.descriptors[best])) {
        best = child;
      }
    }
    node = best;
    if (depth < level) ancestor = node;
  }
  WordId word = 0;
  for (size_t i = 0; i < node; ++i) word += is_word(i) ? 1 : 0;
  return {word, static_cast<NodeId>(ancestor)};
}

TEST(VocabularyTest, FindDescendsToTheNearestChild) {
  Rng rng(1);
  for (const int branching : {2, 5, 10}) {
    const Vocabulary vocabulary = RandomVocabulary(branching, 3, static_cast<uint64_t>(branching));
    for (int i = 0; i < 200; ++i) {
      const Descriptor query = RandomDescriptor(&rng);
      const int level = i % 5;  // one beyond the depth
      const Vocabulary::Place place = vocabulary.Find(query, level);
      const Vocabulary::Place expected = BruteForceFind(vocabulary.tree(), query, level);
      EXPECT_EQ(place.word, expected.word);
      EXPECT_EQ(place.node, expected.node);
    }
  }
}

TEST(VocabularyTest, TransformGathersWhatFindSaysOfEachFeature) {
  const Vocabulary vocabulary = RandomVocabulary(6, 3, 3);
  Rng rng(4);
  const std::vector<Descriptor> features = RandomDescriptors(300, &rng);
  for (int level = 0; level <= 3; ++level) {
    std::map<WordId, double> weights;
    std::map<NodeId, std::vector<int>> below;
    double sum = 0;
    for (int i = 0; i < 300; ++i) {
      const Vocabulary::Place place = vocabulary.Find(features[i], level);
      weights[place.word] += vocabulary.tree().word_weights[place.word];
      sum += vocabulary.tree().word_weights[place.word];
      below[place.node].push_back(i);
    }
    const auto [bow, index] = vocabulary.Transform(features, level);
    ASSERT_EQ(bow.size(), weights.size());
    ASSERT_EQ(index.size(), below.size());
    auto weight = weights.begin();
    for (const BowEntry& entry : bow) {
      EXPECT_EQ(entry.word, weight->first);
      EXPECT_NEAR(entry.weight, (weight++)->second / sum, 1e-6);
    }
    auto node = below.begin();
    for (size_t i = 0; i < index.size(); ++i, ++node) {
      EXPECT_EQ(index.nodes[i], node->first);
      EXPECT_THAT(index.FeaturesOf(i), testing::ElementsAreArray(node->second));
    }
  }
}

TEST(VocabularyTest, NoFeaturesGiveNothing) {
  const auto [bow, index] = RandomVocabulary(3, 2, 5).Transform({}, 1);
  EXPECT_TRUE(bow.empty());
  EXPECT_EQ(index.size(), 0U);
}

TEST(VocabularyTest, RefusesWhatIsNoTree) {
  Rng rng(6);
  const VocabularyTree good = RandomTree(3, 2, &rng);
  const auto refusal = [&](auto damage) {
    VocabularyTree tree = good;
    damage(tree);
    const Result<Vocabulary> vocabulary = Vocabulary::Create(tree);
    return vocabulary ? std::string("accepted") : vocabulary.error().message;
  };
  EXPECT_EQ(refusal([](auto&) {}), "accepted");
  EXPECT_THAT(refusal([](auto& t) { t.branching = 2; }), HasSubstr("more than k children"));
  EXPECT_THAT(refusal([](auto& t) { t.depth = 1; }), HasSubstr("deeper than L"));
  EXPECT_THAT(refusal([](auto& t) { t.child_counts[0] = 0; }), HasSubstr("no parent"));
  EXPECT_THAT(refusal([](auto& t) { t.child_counts.back() = 1; }), HasSubstr("deeper than L"));
  EXPECT_THAT(refusal([](auto& t) { t.descriptors.pop_back(); }), HasSubstr("no nodes"));
  EXPECT_THAT(refusal([](auto& t) { t.word_weights.pop_back(); }), HasSubstr("number of weights"));
  EXPECT_THAT(refusal([](auto& t) { t.word_weights[0] = -1; }), HasSubstr("negative"));
  EXPECT_THAT(refusal([](auto& t) { t.word_weights[0] = std::nanf(""); }), HasSubstr("not finite"));
  EXPECT_THAT(refusal([](auto& t) { t = VocabularyTree{3, 2, {}, {}, {}}; }), HasSubstr("no nodes"));
}

}  // namespace
}  // namespace orbslam
