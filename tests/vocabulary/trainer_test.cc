// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/trainer.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "vocabulary/random_vocabulary.h"

namespace orbslam {
namespace {

/// Images of descriptors that lie near a few random centres.
std::vector<std::vector<Descriptor>> ClusteredImages(int images, int features,
                                                     const std::vector<Descriptor>& centers, Rng* rng) {
  std::vector<std::vector<Descriptor>> all(images);
  for (auto& image : all) {
    for (int i = 0; i < features; ++i) {
      const Descriptor& center = centers[rng->Below(static_cast<uint32_t>(centers.size()))];
      image.push_back(Perturbed(center, 20, rng));
    }
  }
  return all;
}

TrainerOptions Options(int branching, int depth, int num_threads = 1) {
  TrainerOptions options;
  options.branching = branching;
  options.depth = depth;
  options.num_threads = num_threads;
  return options;
}

TEST(TrainerTest, SameTreeWhateverTheNumberOfThreads) {
  Rng rng(1);
  // More descriptors than one large node needs, so that both ways to share the work are taken.
  const auto images = ClusteredImages(100, 800, RandomDescriptors(50, &rng), &rng);
  const Vocabulary alone = TrainVocabulary(images, Options(5, 3, 1)).value();
  for (const int threads : {2, 5}) {
    const Vocabulary shared = TrainVocabulary(images, Options(5, 3, threads)).value();
    EXPECT_EQ(shared.tree().descriptors, alone.tree().descriptors);
    EXPECT_EQ(shared.tree().child_counts, alone.tree().child_counts);
    EXPECT_EQ(shared.tree().word_weights, alone.tree().word_weights);
  }
}

TEST(TrainerTest, FindsSeparatedClusters) {
  Rng rng(2);
  const std::vector<Descriptor> centers = RandomDescriptors(8, &rng);
  const auto images = ClusteredImages(50, 40, centers, &rng);
  const Vocabulary vocabulary = TrainVocabulary(images, Options(8, 1)).value();
  ASSERT_EQ(vocabulary.num_words(), 8);
  std::set<WordId> words;
  for (const Descriptor& center : centers) {
    const Vocabulary::Place place = vocabulary.Find(center, 1);
    words.insert(place.word);
    EXPECT_LE(HammingDistance(center, vocabulary.tree().descriptors[place.node]), 2);
  }
  EXPECT_EQ(words.size(), centers.size());
}

TEST(TrainerTest, WeightsAreInverseDocumentFrequencies) {
  Rng rng(3);
  const std::vector<Descriptor> centers = RandomDescriptors(3, &rng);
  // The first cluster shows in every image, the second in every second one, the third in one of ten.
  std::vector<std::vector<Descriptor>> images(20);
  for (size_t i = 0; i < images.size(); ++i) {
    images[i].push_back(centers[0]);
    if (i % 2 == 0) images[i].insert(images[i].end(), 3, centers[1]);
    if (i % 10 == 0) images[i].push_back(centers[2]);
  }
  const Vocabulary vocabulary = TrainVocabulary(images, Options(4, 2)).value();
  const auto weight = [&](int i) {
    return vocabulary.tree().word_weights[vocabulary.Find(centers[i], 1).word];
  };
  EXPECT_EQ(weight(0), 0);
  EXPECT_FLOAT_EQ(weight(1), std::log(2.0F));
  EXPECT_FLOAT_EQ(weight(2), std::log(10.0F));
}

TEST(TrainerTest, EveryDistinctDescriptorOfAFewBecomesAWord) {
  Rng rng(4);
  std::vector<std::vector<Descriptor>> images{RandomDescriptors(7, &rng)};
  images.push_back(images.front());
  const Vocabulary vocabulary = TrainVocabulary(images, Options(10, 4)).value();
  EXPECT_EQ(vocabulary.num_words(), 7);
  EXPECT_EQ(vocabulary.num_nodes(), 8);
}

TEST(TrainerTest, RefusesWhatCannotBeTrained) {
  EXPECT_FALSE(TrainVocabulary({}, Options(10, 3)).ok());
  const std::vector<std::vector<Descriptor>> same{{Descriptor{}, Descriptor{}}, {}};
  EXPECT_THAT(TrainVocabulary(same, Options(10, 3)).error().message, testing::HasSubstr("two different"));
  EXPECT_FALSE(TrainVocabulary(same, Options(1, 3)).ok());
  EXPECT_FALSE(TrainVocabulary(same, Options(10, 0)).ok());
}

}  // namespace
}  // namespace orbslam
