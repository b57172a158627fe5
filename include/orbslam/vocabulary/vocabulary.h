// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "orbslam/features/descriptor.h"
#include "orbslam/util/result.h"
#include "orbslam/vocabulary/bow.h"

namespace orbslam {

/// The tree as it is stored: nodes in breadth-first order, so that the children of a node are neighbours in
/// memory and where they start follows from the counts of the nodes before. Node 0 is the root; its
/// descriptor means nothing.
struct VocabularyTree {
  int branching = 0;                    // k: no node has more children, at most 255
  int depth = 0;                        // L: no leaf is deeper; the root's depth is 0
  std::vector<Descriptor> descriptors;  // one a node
  std::vector<uint8_t> child_counts;    // one a node; 0: the node is a word
  std::vector<float> word_weights;  // one a word, in the order of the nodes: inverse document frequency, >= 0
};

/// A hierarchical bag of binary words (Nister and Stewenius, "Scalable recognition with a vocabulary tree",
/// CVPR 2006; Galvez-Lopez and Tardos, "Bags of binary words for fast place recognition", T-RO 2012) with
/// TF-IDF weights. Immutable; safe to use from many threads.
class Vocabulary {
 public:
  /// Refuses a tree that is not one (counts that do not add up, deeper than stated, bad weights) with one
  /// line.
  static Result<Vocabulary> Create(VocabularyTree tree);

  struct Place {
    WordId word = 0;
    NodeId node =
        0;  // the ancestor at the level asked for, or the word's own node where the tree is shallower
  };
  /// Descends from the root to the nearest child, ties to the first, down to a word. level 0 is the root.
  Place Find(const Descriptor& descriptor, int level) const;

  struct Transformed {
    BowVector bow;
    DirectIndex direct_index;
  };
  /// The bag of words of an image and the direct index at direct_index_level (levels from the root, 0 to
  /// depth). Words of weight 0 are in the direct index only.
  Transformed Transform(std::span<const Descriptor> descriptors, int direct_index_level) const;

  int branching() const { return tree_.branching; }
  int depth() const { return tree_.depth; }
  int num_words() const { return static_cast<int>(tree_.word_weights.size()); }
  int num_nodes() const { return static_cast<int>(tree_.descriptors.size()); }
  const VocabularyTree& tree() const { return tree_; }

 private:
  struct Node {
    uint32_t first;  // first child, or the word if there are no children
    uint32_t children;
  };
  void FindAll(std::span<const Descriptor> descriptors, int level, Place* places) const;

  VocabularyTree tree_;
  std::vector<Node> nodes_;
};

}  // namespace orbslam
