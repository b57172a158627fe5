// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "orbslam/features/frame_features.h"
#include "orbslam/util/ids.h"
#include "orbslam/vocabulary/keyframe_index.h"
#include "orbslam/vocabulary/vocabulary.h"

namespace orbslam {

/// Which keyframes look like this? The vocabulary, every keyframe's bag of words and the inverted file,
/// shared by loop closing (which fills it) and relocalisation. Safe to use from several threads. Keyframes
/// that are culled from the map are to be removed; one that is still listed for a moment does no harm,
/// callers look ids up in the map anyway.
class PlaceIndex {
 public:
  using Words = Vocabulary::Transformed;

  explicit PlaceIndex(std::shared_ptr<const Vocabulary> vocabulary) : vocabulary_(std::move(vocabulary)) {}

  /// The bag of words and direct index of a frame. Takes no lock.
  std::shared_ptr<const Words> Transform(const FrameFeatures& features) const;

  void Add(KeyFrameId id, std::shared_ptr<const Words> words);
  void Remove(KeyFrameId id);
  /// nullptr: not listed.
  std::shared_ptr<const Words> Find(KeyFrameId id) const;
  /// Keyframes that share the most words with the query, best score first.
  std::vector<KeyFrameIndex::Candidate> Query(const BowVector& query,
                                              std::span<const KeyFrameId> excluded) const;

 private:
  std::shared_ptr<const Vocabulary> vocabulary_;
  mutable std::mutex mutex_;
  KeyFrameIndex index_;
  std::map<KeyFrameId, std::shared_ptr<const Words>> words_;
};

}  // namespace orbslam
