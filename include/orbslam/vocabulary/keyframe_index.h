// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "orbslam/util/ids.h"
#include "orbslam/vocabulary/bow.h"

namespace orbslam {

/// Inverted file: which keyframes show which word, so that a query touches only keyframes that share a word
/// with it (Galvez-Lopez and Tardos, T-RO 2012, section IV). Not synchronised: its owner guards it.
class KeyFrameIndex {
 public:
  /// id must not be in the index.
  void Add(KeyFrameId id, const BowVector& bow);
  /// Forgets id; nothing happens when it is not in the index.
  void Remove(KeyFrameId id);

  struct Candidate {
    KeyFrameId id;
    int common_words = 0;
    float score = 0;  // Score(query, the keyframe's bag of words)

    friend bool operator==(const Candidate&, const Candidate&) = default;
  };
  /// The keyframes, but for the excluded ones, that share at least min_common_ratio of the most words that
  /// any of them shares with the query (ORB-SLAM, Mur-Artal et al. 2015, section III-E, uses 0.8), and at
  /// least one; best score first, ties by ascending id.
  std::vector<Candidate> Query(const BowVector& query, std::span<const KeyFrameId> excluded = {},
                               double min_common_ratio = 0.8) const;

  bool Contains(KeyFrameId id) const { return words_.contains(id); }
  size_t size() const { return words_.size(); }

 private:
  struct Posting {
    KeyFrameId id;
    float weight;
  };
  std::unordered_map<WordId, std::vector<Posting>> postings_;
  std::unordered_map<KeyFrameId, std::vector<WordId>> words_;
};

}  // namespace orbslam
