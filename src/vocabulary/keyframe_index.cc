// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/keyframe_index.h"

#include <algorithm>
#include <tuple>
#include <unordered_set>

#include "orbslam/util/check.h"

namespace orbslam {

void KeyFrameIndex::Add(KeyFrameId id, const BowVector& bow) {
  auto [entry, is_new] = words_.try_emplace(id);
  ORBSLAM_CHECK(is_new);
  entry->second.reserve(bow.size());
  for (const BowEntry& item : bow) {
    postings_[item.word].push_back({id, item.weight});
    entry->second.push_back(item.word);
  }
}

void KeyFrameIndex::Remove(KeyFrameId id) {
  const auto entry = words_.find(id);
  if (entry == words_.end()) return;
  for (const WordId word : entry->second) {
    const auto list = postings_.find(word);
    std::erase_if(list->second, [id](const Posting& posting) { return posting.id == id; });
    if (list->second.empty()) postings_.erase(list);
  }
  words_.erase(entry);
}

std::vector<KeyFrameIndex::Candidate> KeyFrameIndex::Query(const BowVector& query,
                                                           std::span<const KeyFrameId> excluded,
                                                           double min_common_ratio) const {
  const std::unordered_set<KeyFrameId> left_out(excluded.begin(), excluded.end());
  std::unordered_map<KeyFrameId, Candidate> sharing;
  for (const BowEntry& item : query) {
    const auto list = postings_.find(item.word);
    if (list == postings_.end()) continue;
    for (const Posting& posting : list->second) {
      Candidate& candidate = sharing[posting.id];
      ++candidate.common_words;
      candidate.score += std::min(item.weight, posting.weight);  // in the order of words, as Score() adds up
    }
  }

  int most_common = 0;
  for (const auto& [id, candidate] : sharing) {
    if (!left_out.contains(id)) most_common = std::max(most_common, candidate.common_words);
  }
  std::vector<Candidate> candidates;
  for (const auto& [id, candidate] : sharing) {
    if (candidate.common_words < min_common_ratio * most_common || left_out.contains(id)) continue;
    candidates.push_back({id, candidate.common_words, std::min(candidate.score, 1.0F)});
  }
  std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
    return std::tuple(-a.score, a.id) < std::tuple(-b.score, b.id);
  });
  return candidates;
}

}  // namespace orbslam
