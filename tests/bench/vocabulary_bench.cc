// SPDX-License-Identifier: GPL-3.0-or-later
// Opening the shipped vocabulary, describing an image by its words, asking an index of 1000 keyframes.
#include <benchmark/benchmark.h>

#include "orbslam/vocabulary/keyframe_index.h"
#include "orbslam/vocabulary/vocabulary_file.h"
#include "vocabulary/random_vocabulary.h"

namespace orbslam {
namespace {

constexpr const char* kShipped = ORBSLAM_SHIPPED_VOCABULARY;

/// A thousand descriptors near words of the vocabulary.
std::vector<Descriptor> MakeImage(const Vocabulary& vocabulary, uint64_t seed) {
  Rng rng(seed);
  std::vector<Descriptor> image;
  const auto num_nodes = static_cast<uint32_t>(vocabulary.num_nodes());
  for (int i = 0; i < 1000; ++i) {
    image.push_back(Perturbed(vocabulary.tree().descriptors[rng.Below(num_nodes)], 20, &rng));
  }
  return image;
}

void BM_Open(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ReadVocabulary(kShipped).value().num_words());
}
BENCHMARK(BM_Open)->Unit(benchmark::kMillisecond);

void BM_Transform(benchmark::State& state) {
  const Vocabulary vocabulary = ReadVocabulary(kShipped).value();
  const std::vector<Descriptor> image = MakeImage(vocabulary, 1);
  for (auto _ : state) benchmark::DoNotOptimize(vocabulary.Transform(image, 2));
}
BENCHMARK(BM_Transform)->Unit(benchmark::kMicrosecond);

void BM_Query(benchmark::State& state) {
  const Vocabulary vocabulary = ReadVocabulary(kShipped).value();
  KeyFrameIndex index;
  for (uint32_t i = 0; i < 1000; ++i)
    index.Add(KeyFrameId(i), vocabulary.Transform(MakeImage(vocabulary, i), 2).bow);
  const BowVector query = vocabulary.Transform(MakeImage(vocabulary, 5), 2).bow;
  for (auto _ : state) benchmark::DoNotOptimize(index.Query(query));
}
BENCHMARK(BM_Query)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace orbslam

BENCHMARK_MAIN();
