// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace orbslam {

/// A leaf of the vocabulary tree, 0 to num_words - 1.
using WordId = uint32_t;
/// Any node of the vocabulary tree; 0 is the root.
using NodeId = uint32_t;

struct BowEntry {
  WordId word = 0;
  float weight = 0;

  friend bool operator==(const BowEntry&, const BowEntry&) = default;
};

/// An image as a bag of words: ascending by word, no word twice, positive weights that add up to 1 (or
/// empty).
using BowVector = std::vector<BowEntry>;

/// Which features of an image lie below which node at one level of the tree: two images' features need to be
/// compared only where they share a node (Galvez-Lopez and Tardos, T-RO 2012, section IV). Flat and sorted.
struct DirectIndex {
  std::vector<NodeId> nodes;  // ascending
  std::vector<int> starts;    // nodes.size() + 1 offsets into features (none when there are no nodes)
  std::vector<int> features;  // feature indices, ascending within a node

  size_t size() const { return nodes.size(); }
  /// The features below nodes[i].
  std::span<const int> FeaturesOf(size_t i) const {
    return std::span(features).subspan(starts[i], starts[i + 1] - starts[i]);
  }
};

/// Similarity 1 - |a - b|_1 / 2 of two bags of words, in [0, 1]; 1 is the same. (Nister and Stewenius, CVPR
/// 2006, equation 5: for vectors of norm 1 without negative entries it is the sum of min(a_i, b_i).)
float Score(const BowVector& a, const BowVector& b);

}  // namespace orbslam
