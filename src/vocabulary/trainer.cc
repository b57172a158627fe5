// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/trainer.h"

#include <cmath>
#include <utility>

#include "hamming_clusters.h"
#include "parallel_for.h"

namespace orbslam {
namespace {

constexpr size_t kLargeNode = 65536;  // descriptors from which on a node is worth all threads

/// The tree while it grows. The samples of a node are neighbours in memory, and in the order of their images.
class Grower {
 public:
  Grower(std::span<const std::vector<Descriptor>> images, const TrainerOptions& options)
      : options_(options), num_images_(images.size()) {
    for (uint32_t i = 0; i < images.size(); ++i) {
      samples_.insert(samples_.end(), images[i].begin(), images[i].end());
      image_of_.resize(samples_.size(), i);
    }
    tree_.branching = options.branching;
    tree_.depth = options.depth;
    AddNode(Descriptor{}, {0, samples_.size()});
  }

  VocabularyTree Grow() {
    size_t level_begin = 0;
    for (int level = 0; level < options_.depth; ++level) {
      const size_t level_end = ranges_.size();
      AddChildren(SplitAll(level_begin, level_end), level_begin);
      level_begin = level_end;
      if (options_.on_level) options_.on_level(level + 1, static_cast<int>(ranges_.size() - level_begin));
    }
    for (size_t node = 0; node < ranges_.size(); ++node) {
      if (tree_.child_counts[node] == 0)
        tree_.word_weights.push_back(InverseDocumentFrequency(ranges_[node]));
    }
    return std::move(tree_);
  }

 private:
  struct Range {
    size_t begin, end;
    size_t size() const { return end - begin; }
  };
  struct Child {
    Descriptor center;
    Range range;
  };
  using Children = std::vector<Child>;

  void AddNode(const Descriptor& descriptor, Range range) {
    tree_.descriptors.push_back(descriptor);
    tree_.child_counts.push_back(0);
    ranges_.push_back(range);
  }

  /// The children of nodes [begin, end): large nodes one by one on all threads, small ones a thread each.
  std::vector<Children> SplitAll(size_t begin, size_t end) {
    std::vector<Children> split(end - begin);
    std::vector<size_t> small;
    for (size_t node = begin; node < end; ++node) {
      if (ranges_[node].size() < kLargeNode) {
        small.push_back(node);
      } else {
        split[node - begin] = Split(node, options_.num_threads);
      }
    }
    ParallelFor(small.size(), options_.num_threads,
                [&](size_t i) { split[small[i] - begin] = Split(small[i], 1); });
    return split;
  }

  /// Clusters the samples of a node and sorts them by cluster; none when they are all the same.
  Children Split(size_t node, int num_threads) {
    const Range range = ranges_[node];
    if (range.size() < 2) return {};
    const ClusterOptions cluster_options{options_.branching, options_.max_iterations, num_threads};
    const auto samples = std::span(samples_).subspan(range.begin, range.size());
    const HammingClusters clusters = ClusterDescriptors(samples, cluster_options, Rng(options_.seed, node));
    if (clusters.centers.size() < 2) return {};

    Children children;
    for (const Descriptor& center : clusters.centers) children.push_back({center, {0, 0}});
    for (const uint8_t label : clusters.labels) ++children[label].range.end;
    size_t begin = range.begin;
    for (Child& child : children) {
      child.range = {begin, begin + child.range.end};
      begin = child.range.end;
    }
    SortByLabel(range, clusters.labels, children);
    return children;
  }

  void SortByLabel(Range range, const std::vector<uint8_t>& labels, const Children& children) {
    const std::vector<Descriptor> old_samples(samples_.begin() + range.begin, samples_.begin() + range.end);
    const std::vector<uint32_t> old_images(image_of_.begin() + range.begin, image_of_.begin() + range.end);
    std::vector<size_t> next;
    for (const Child& child : children) next.push_back(child.range.begin);
    for (size_t i = 0; i < labels.size(); ++i) {
      const size_t at = next[labels[i]]++;
      samples_[at] = old_samples[i];
      image_of_[at] = old_images[i];
    }
  }

  void AddChildren(const std::vector<Children>& split, size_t level_begin) {
    for (size_t i = 0; i < split.size(); ++i) {
      tree_.child_counts[level_begin + i] = static_cast<uint8_t>(split[i].size());
      for (const Child& child : split[i]) AddNode(child.center, child.range);
    }
  }

  float InverseDocumentFrequency(Range range) const {
    size_t images = 1;
    for (size_t i = range.begin + 1; i < range.end; ++i) images += image_of_[i] != image_of_[i - 1] ? 1 : 0;
    return static_cast<float>(std::log(static_cast<double>(num_images_) / static_cast<double>(images)));
  }

  const TrainerOptions& options_;
  size_t num_images_;
  std::vector<Descriptor> samples_;
  std::vector<uint32_t> image_of_;  // one a sample
  VocabularyTree tree_;
  std::vector<Range> ranges_;  // one a node
};

}  // namespace

Result<Vocabulary> TrainVocabulary(std::span<const std::vector<Descriptor>> images,
                                   const TrainerOptions& options) {
  if (options.branching < 2 || options.branching > 255) return Error{"k must lie within 2 and 255"};
  if (options.depth < 1 || options.depth > 32) return Error{"L must lie within 1 and 32"};
  VocabularyTree tree = Grower(images, options).Grow();
  if (tree.child_counts.front() == 0) return Error{"there are no two different descriptors to train on"};
  return Vocabulary::Create(std::move(tree));
}

}  // namespace orbslam
