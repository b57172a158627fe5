// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/vocabulary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nearest_child.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

Error Refuse(const std::string& what) { return Error{"not a vocabulary tree: " + what}; }

/// (word or node, index of the feature), ascending: groups equal keys and keeps features in order.
using KeyedFeature = std::pair<uint32_t, int>;

BowVector MakeBow(std::span<const KeyedFeature> by_word, std::span<const float> word_weights) {
  BowVector bow;
  double sum = 0;
  for (size_t i = 0; i < by_word.size();) {
    const WordId word = by_word[i].first;
    const size_t begin = i;
    while (i < by_word.size() && by_word[i].first == word) ++i;
    const float weight = static_cast<float>(i - begin) * word_weights[word];
    if (weight > 0) bow.push_back({word, weight});
    sum += weight;
  }
  for (BowEntry& entry : bow) entry.weight = static_cast<float>(entry.weight / sum);
  return bow;
}

DirectIndex MakeDirectIndex(std::span<const KeyedFeature> by_node) {
  DirectIndex index;
  if (by_node.empty()) return index;
  index.features.reserve(by_node.size());
  for (const auto& [node, feature] : by_node) {
    if (index.nodes.empty() || index.nodes.back() != node) {
      index.nodes.push_back(node);
      index.starts.push_back(static_cast<int>(index.features.size()));
    }
    index.features.push_back(feature);
  }
  index.starts.push_back(static_cast<int>(index.features.size()));
  return index;
}

}  // namespace

Result<Vocabulary> Vocabulary::Create(VocabularyTree tree) {
  const size_t num_nodes = tree.child_counts.size();
  if (tree.branching < 2 || tree.branching > 255) return Refuse("k is not within 2 to 255");
  if (tree.depth < 1 || tree.depth > 32) return Refuse("L is not within 1 to 32");
  if (num_nodes < 2 || tree.descriptors.size() != num_nodes) return Refuse("it has no nodes");

  Vocabulary vocabulary;
  vocabulary.nodes_.reserve(num_nodes);
  uint32_t next_child = 1, next_word = 0, level_end = 1;
  int level = 0;
  for (uint32_t i = 0; i < num_nodes; ++i) {
    if (i == level_end) {
      level_end = next_child;
      ++level;
    }
    const uint32_t children = tree.child_counts[i];
    if (children > static_cast<uint32_t>(tree.branching)) return Refuse("a node has more than k children");
    if (children > 0 && level >= tree.depth) return Refuse("it is deeper than L levels");
    vocabulary.nodes_.push_back({children > 0 ? next_child : next_word, children});
    next_child += children;
    next_word += children == 0 ? 1 : 0;
    if (next_child <= i + 1 && i + 1 < num_nodes) return Refuse("a node has no parent");
  }
  if (next_child != num_nodes) return Refuse("children are missing");
  if (next_word != tree.word_weights.size()) return Refuse("the number of weights is not that of the words");
  for (const float weight : tree.word_weights) {
    if (!(weight >= 0) || !std::isfinite(weight)) return Refuse("a weight is negative or not finite");
  }
  vocabulary.tree_ = std::move(tree);
  return vocabulary;
}

void Vocabulary::FindAll(std::span<const Descriptor> descriptors, int level, Place* places) const {
  const NearestChildFunction nearest_child = BestNearestChild();
  for (size_t i = 0; i < descriptors.size(); ++i) {
    NodeId node = 0, at_level = 0;
    for (int depth = 0; nodes_[node].children > 0; ++depth) {
      const Node& parent = nodes_[node];
      node = parent.first + nearest_child(descriptors[i], &tree_.descriptors[parent.first], parent.children);
      if (depth < level) at_level = node;
    }
    places[i] = {nodes_[node].first, at_level};
  }
}

Vocabulary::Place Vocabulary::Find(const Descriptor& descriptor, int level) const {
  Place place;
  FindAll({&descriptor, 1}, level, &place);
  return place;
}

Vocabulary::Transformed Vocabulary::Transform(std::span<const Descriptor> descriptors,
                                              int direct_index_level) const {
  ORBSLAM_CHECK(direct_index_level >= 0);
  std::vector<Place> places(descriptors.size());
  FindAll(descriptors, direct_index_level, places.data());

  std::vector<KeyedFeature> by_word(places.size()), by_node(places.size());
  for (size_t i = 0; i < places.size(); ++i) {
    by_word[i] = {places[i].word, static_cast<int>(i)};
    by_node[i] = {places[i].node, static_cast<int>(i)};
  }
  std::ranges::sort(by_word);
  std::ranges::sort(by_node);
  return {MakeBow(by_word, tree_.word_weights), MakeDirectIndex(by_node)};
}

}  // namespace orbslam
