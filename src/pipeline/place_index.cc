// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/place_index.h"

#include <algorithm>

namespace orbslam {
namespace {

/// Features are compared where they share a node this many levels above the words: enough tolerance for a
/// descriptor that took a wrong turn near the leaves (Galvez-Lopez and Tardos, T-RO 2012, section IV).
constexpr int kLevelsAboveWords = 3;

}  // namespace

std::shared_ptr<const PlaceIndex::Words> PlaceIndex::Transform(const FrameFeatures& features) const {
  const int level = std::max(1, vocabulary_->depth() - kLevelsAboveWords);
  return std::make_shared<const Words>(vocabulary_->Transform(features.descriptors, level));
}

void PlaceIndex::Add(KeyFrameId id, std::shared_ptr<const Words> words) {
  const std::lock_guard lock(mutex_);
  index_.Add(id, words->bow);
  words_[id] = std::move(words);
}

void PlaceIndex::Remove(KeyFrameId id) {
  const std::lock_guard lock(mutex_);
  index_.Remove(id);
  words_.erase(id);
}

std::shared_ptr<const PlaceIndex::Words> PlaceIndex::Find(KeyFrameId id) const {
  const std::lock_guard lock(mutex_);
  const auto found = words_.find(id);
  return found == words_.end() ? nullptr : found->second;
}

std::vector<KeyFrameIndex::Candidate> PlaceIndex::Query(const BowVector& query,
                                                        std::span<const KeyFrameId> excluded) const {
  const std::lock_guard lock(mutex_);
  return index_.Query(query, excluded);
}

}  // namespace orbslam
