// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/word_search.h"

#include <gmock/gmock.h>

#include <cmath>

#include "matching/random_features.h"

namespace orbslam::test {
namespace {

constexpr NodeId kNumNodes = 12;

/// Features spread over nodes at random; each frame lacks some nodes.
class WordSearch : public testing::TestWithParam<int> {
 protected:
  WordSearch() {
    for (int i = 0; i < to_.size(); ++i) {
      to_.descriptors[i] = WithNoise(from_.descriptors[i], 30, &rng_);
      to_.angles_deg[i] = std::fmod(from_.angles_deg[i] + 30, 360.0f);
    }
    for (int i = 0; i < from_.size(); ++i) {
      node_from_.push_back(rng_.Below(kNumNodes - 2));
      node_to_.push_back(rng_.Below(4) > 0 ? node_from_[i] : 2 + rng_.Below(kNumNodes - 2));
      part_from_.push_back(rng_.Below(5) > 0);
      part_to_.push_back(rng_.Below(5) > 0);
    }
  }

  static std::vector<int> Select(const std::vector<NodeId>& node_of, NodeId node,
                                 const std::vector<char>& takes_part) {
    std::vector<int> selected;
    for (int i = 0; i < std::ssize(node_of); ++i) {
      if (node_of[i] == node && (takes_part.empty() || takes_part[i])) selected.push_back(i);
    }
    return selected;
  }
  static DirectIndex Index(const std::vector<NodeId>& node_of) {
    DirectIndex index{{}, {0}, {}};
    for (NodeId node = 0; node < kNumNodes; ++node) {
      const std::vector<int> features = Select(node_of, node, {});
      if (features.empty()) continue;
      index.nodes.push_back(node);
      index.features.insert(index.features.end(), features.begin(), features.end());
      index.starts.push_back(static_cast<int>(index.features.size()));
    }
    return index;
  }
  std::vector<int> Search(const std::vector<char>& part_from, const std::vector<char>& part_to,
                          const DescriptorSearchOptions& options) const {
    return SearchByWords(from_, Index(node_from_), part_from, to_, Index(node_to_), part_to, options);
  }
  /// Node by node with the search that looks at everything.
  std::vector<int> SearchNodes(const std::vector<char>& part_from, const std::vector<char>& part_to,
                               const DescriptorSearchOptions& options) const {
    std::vector<int> match(from_.size(), -1);
    for (NodeId node = 0; node < kNumNodes; ++node) {
      const std::vector<int> from = Select(node_from_, node, part_from);
      const std::vector<int> found =
          SearchByDescriptor(from_, from, to_, Select(node_to_, node, part_to), options);
      for (size_t q = 0; q < from.size(); ++q) match[from[q]] = found[q];
    }
    return match;
  }

  Rng rng_{static_cast<uint64_t>(GetParam())};
  FrameFeatures from_ = RandomFeatures(300, &rng_), to_ = from_;
  std::vector<NodeId> node_from_, node_to_;
  std::vector<char> part_from_, part_to_;
};

int NumFound(const std::vector<int>& match) {
  return static_cast<int>(std::ranges::count_if(match, [](int m) { return m >= 0; }));
}

TEST_P(WordSearch, EqualsSearchingNodeByNode) {
  for (const double max_ratio : {0.95, 0.7}) {
    const DescriptorSearchOptions options{
        .max_distance = 70, .max_ratio = max_ratio, .check_orientation = false};
    const std::vector<int> all = Search({}, {}, options), some = Search(part_from_, part_to_, options);
    EXPECT_EQ(all, SearchNodes({}, {}, options));
    EXPECT_EQ(some, SearchNodes(part_from_, part_to_, options));
    EXPECT_GT(NumFound(some), 50);
    EXPECT_GT(NumFound(all), NumFound(some));
  }
}

TEST_P(WordSearch, KeypointsThatTurnedAgainstTheRestAreDropped) {
  const std::vector<int> before = Search({}, {}, {});
  int num_turned = 0;
  for (int i = 0; i < from_.size(); i += 25) {
    if (before[i] >= 0) to_.angles_deg[before[i]] = std::fmod(from_.angles_deg[i] + 200, 360.0f);
  }
  const std::vector<int> after = Search({}, {}, {});
  for (int i = 0; i < from_.size(); ++i) {
    const bool is_turned = i % 25 == 0 && before[i] >= 0;
    num_turned += is_turned;
    EXPECT_EQ(after[i], is_turned ? -1 : before[i]);
  }
  EXPECT_GT(num_turned, 3);
}

TEST_P(WordSearch, NothingSharedNothingFound) {
  for (NodeId& node : node_from_) node = node % 6;
  for (NodeId& node : node_to_) node = 6 + node % 6;
  EXPECT_EQ(NumFound(Search({}, {}, {})), 0);
  node_to_ = node_from_;
  EXPECT_GT(NumFound(Search({}, {}, {})), 100);
  EXPECT_EQ(NumFound(Search(std::vector<char>(300, 0), {}, {})), 0);
  EXPECT_TRUE(SearchByWords({}, {}, {}, to_, Index(node_to_), {}, {}).empty());
}

INSTANTIATE_TEST_SUITE_P(Seeds, WordSearch, testing::Range(1, 4));

}  // namespace
}  // namespace orbslam::test
