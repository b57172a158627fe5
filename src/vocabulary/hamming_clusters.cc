// SPDX-License-Identifier: GPL-3.0-or-later
#include "hamming_clusters.h"

#include <algorithm>
#include <atomic>

#include "bit_counter.h"
#include "nearest_child.h"
#include "orbslam/util/check.h"
#include "parallel_for.h"

namespace orbslam {
namespace {

constexpr size_t kChunk =
    16384;  // descriptors that one thread takes at a time; sums are of integers: no rounding

size_t NumChunks(size_t count) { return (count + kChunk - 1) / kChunk; }

template <class Work>
void ForEachChunk(size_t count, int num_threads, const Work& work) {
  ParallelFor(NumChunks(count), num_threads,
              [&](size_t chunk) { work(chunk, chunk * kChunk, std::min(count, (chunk + 1) * kChunk)); });
}

/// Seeds, one after the other, with a probability that grows with the squared distance to the seeds so far.
class Seeder {
 public:
  Seeder(std::span<const Descriptor> descriptors, int num_threads)
      : descriptors_(descriptors),
        num_threads_(num_threads),
        weights_(descriptors.size(), 257 * 257),
        chunk_sums_(NumChunks(descriptors.size())) {}

  std::vector<Descriptor> Draw(int count, Rng* rng) {
    std::vector<Descriptor> seeds{descriptors_[(*rng)() % descriptors_.size()]};
    while (static_cast<int>(seeds.size()) < count) {
      const uint64_t total = Approach(seeds.back());
      if (total == 0) break;  // every descriptor is a seed
      seeds.push_back(descriptors_[Locate((*rng)() % total)]);
    }
    return seeds;
  }

 private:
  /// Takes the new seed into account; returns the sum of all weights.
  uint64_t Approach(const Descriptor& seed) {
    ForEachChunk(descriptors_.size(), num_threads_, [&](size_t chunk, size_t begin, size_t end) {
      uint64_t sum = 0;
      for (size_t i = begin; i < end; ++i) {
        const auto distance = static_cast<uint32_t>(HammingDistance(descriptors_[i], seed));
        weights_[i] = std::min(weights_[i], distance * distance);
        sum += weights_[i];
      }
      chunk_sums_[chunk] = sum;
    });
    uint64_t total = 0;
    for (const uint64_t sum : chunk_sums_) total += sum;
    return total;
  }

  /// The descriptor in whose share of the total `at` falls.
  size_t Locate(uint64_t at) const {
    size_t chunk = 0;
    while (at >= chunk_sums_[chunk]) at -= chunk_sums_[chunk++];
    size_t i = chunk * kChunk;
    while (at >= weights_[i]) at -= weights_[i++];
    return i;
  }

  std::span<const Descriptor> descriptors_;
  int num_threads_;
  std::vector<uint32_t> weights_;
  std::vector<uint64_t> chunk_sums_;
};

/// Gives every descriptor its nearest centre; returns whether any changed.
bool Assign(std::span<const Descriptor> descriptors, int num_threads, HammingClusters* clusters) {
  const NearestChildFunction nearest = BestNearestChild();
  const auto num_centers = static_cast<uint32_t>(clusters->centers.size());
  std::atomic<bool> changed = false;
  ForEachChunk(descriptors.size(), num_threads, [&](size_t, size_t begin, size_t end) {
    bool changed_here = false;
    for (size_t i = begin; i < end; ++i) {
      const auto label = static_cast<uint8_t>(nearest(descriptors[i], clusters->centers.data(), num_centers));
      changed_here |= label != clusters->labels[i];
      clusters->labels[i] = label;
    }
    if (changed_here) changed = true;
  });
  return changed;
}

/// Moves every centre to the majority of its descriptors; one that has none stays.
void MoveCenters(std::span<const Descriptor> descriptors, int num_threads, HammingClusters* clusters) {
  const size_t num_centers = clusters->centers.size();
  std::vector<BitCounter> counters(NumChunks(descriptors.size()) * num_centers);
  ForEachChunk(descriptors.size(), num_threads, [&](size_t chunk, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      counters[chunk * num_centers + clusters->labels[i]].Add(descriptors[i]);
    }
  });
  for (size_t center = 0; center < num_centers; ++center) {
    BitCounter total;
    for (size_t i = center; i < counters.size(); i += num_centers) total.Add(counters[i]);
    if (total.size() > 0) clusters->centers[center] = total.Majority(clusters->centers[center]);
  }
}

void DropEmpty(HammingClusters* clusters) {
  std::vector<bool> used(clusters->centers.size());
  for (const uint8_t label : clusters->labels) used[label] = true;
  std::vector<uint8_t> new_label(used.size());
  std::vector<Descriptor> kept;
  for (size_t i = 0; i < used.size(); ++i) {
    new_label[i] = static_cast<uint8_t>(kept.size());
    if (used[i]) kept.push_back(clusters->centers[i]);
  }
  for (uint8_t& label : clusters->labels) label = new_label[label];
  clusters->centers = std::move(kept);
}

}  // namespace

HammingClusters ClusterDescriptors(std::span<const Descriptor> descriptors, const ClusterOptions& options,
                                   Rng rng) {
  ORBSLAM_CHECK(!descriptors.empty() && options.num_clusters >= 1 && options.num_clusters <= 255);
  HammingClusters clusters;
  clusters.centers = Seeder(descriptors, options.num_threads).Draw(options.num_clusters, &rng);
  clusters.labels.assign(descriptors.size(), 255);
  for (int i = 0; Assign(descriptors, options.num_threads, &clusters) && i < options.max_iterations; ++i) {
    MoveCenters(descriptors, options.num_threads, &clusters);
  }
  DropEmpty(&clusters);
  return clusters;
}

}  // namespace orbslam
