// SPDX-License-Identifier: GPL-3.0-or-later
// Times of the searches, for frames of 1000 keypoints.
#include <benchmark/benchmark.h>

#include <numeric>

#include "matching/random_features.h"
#include "orbslam/features/scale_pyramid.h"
#include "orbslam/matching/descriptor_search.h"
#include "orbslam/matching/epipolar_search.h"
#include "orbslam/matching/projection_search.h"
#include "orbslam/matching/word_search.h"
#include "orbslam/vocabulary/vocabulary_file.h"

namespace orbslam::test {
namespace {

constexpr int kNumKeypoints = 1000;

std::vector<int> AllIndices() {
  std::vector<int> indices(kNumKeypoints);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

void SearchByProjection(benchmark::State& state) {
  Rng rng(1);
  const FrameFeatures features = RandomFeatures(kNumKeypoints, &rng);
  std::vector<ProjectionQuery> queries;
  for (int i = 0; i < kNumKeypoints; ++i) {
    queries.push_back({.descriptor = features.descriptors[i],
                       .u = features.pixels[i].x + 1,
                       .v = features.pixels[i].y + 1,
                       .radius_px = static_cast<float>(state.range(0)),
                       .min_level = features.levels[i] - 1,
                       .max_level = features.levels[i]});
  }
  for (auto _ : state) benchmark::DoNotOptimize(SearchByProjection(queries, features, {}, {}));
}
BENCHMARK(SearchByProjection)->ArgName("radius_px")->Arg(5)->Arg(15)->Arg(40)->Unit(benchmark::kMillisecond);

void SearchByDescriptor(benchmark::State& state) {
  Rng rng(2);
  const FrameFeatures from = RandomFeatures(kNumKeypoints, &rng), to = RandomFeatures(kNumKeypoints, &rng);
  const std::vector<int> all = AllIndices();
  for (auto _ : state) benchmark::DoNotOptimize(SearchByDescriptor(from, all, to, all, {}));
}
BENCHMARK(SearchByDescriptor)->Unit(benchmark::kMillisecond);

void SearchByEpipolarLine(benchmark::State& state) {
  Rng rng(3);
  const FrameFeatures from = RandomFeatures(kNumKeypoints, &rng), to = RandomFeatures(kNumKeypoints, &rng);
  const std::vector<int> all = AllIndices();
  Eigen::Matrix3d fundamental;  // of a camera that moved sideways: lines are rows
  fundamental << 0, 0, 0, 0, 0, -1, 0, 1, 0;
  const ScalePyramid pyramid(8, 1.2);
  for (auto _ : state)
    benchmark::DoNotOptimize(SearchByEpipolarLine(from, all, to, all, fundamental, pyramid));
}
BENCHMARK(SearchByEpipolarLine)->Unit(benchmark::kMillisecond);

void SearchByWords(benchmark::State& state) {
  const auto vocabulary = ReadVocabulary(ORBSLAM_SHIPPED_VOCABULARY);
  if (!vocabulary) return state.SkipWithError(vocabulary.error().message.c_str());
  Rng rng(4);
  const FrameFeatures from = RandomFeatures(kNumKeypoints, &rng), to = RandomFeatures(kNumKeypoints, &rng);
  const auto from_words = vocabulary->Transform(from.descriptors, 2),
             to_words = vocabulary->Transform(to.descriptors, 2);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        SearchByWords(from, from_words.direct_index, {}, to, to_words.direct_index, {}, {}));
  }
}
BENCHMARK(SearchByWords)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbslam::test

BENCHMARK_MAIN();
