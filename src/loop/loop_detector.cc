// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_detector.h"

#include <algorithm>
#include <limits>

namespace orbslam {

std::vector<KeyFrameId> LoopDetector::Detect(KeyFrameId keyframe, const PlaceIndex::Words& words) {
  std::vector<Group> groups;
  std::vector<KeyFrameId> consistent;
  const std::vector<KeyFrameId> similar = FindSimilar(keyframe, words);
  const auto guard = map_.Read();
  for (const KeyFrameId candidate : similar) {
    if (guard->Find(candidate) == nullptr) continue;
    Group group = MakeGroup(*guard, candidate);
    for (const Group& earlier : groups_) {
      const bool overlaps =
          std::ranges::any_of(group.members, [&](KeyFrameId id) { return earlier.members.contains(id); });
      if (overlaps) group.consistency = std::max(group.consistency, earlier.consistency + 1);
    }
    if (group.consistency >= options_.min_consistency) consistent.push_back(candidate);
    groups.push_back(std::move(group));
  }
  groups_ = std::move(groups);
  return consistent;
}

std::vector<KeyFrameId> LoopDetector::FindSimilar(KeyFrameId keyframe_id,
                                                  const PlaceIndex::Words& words) const {
  std::vector<KeyFrameId> connected{keyframe_id}, neighbors;
  {
    const auto guard = map_.Read();
    const KeyFrame* keyframe = guard->Find(keyframe_id);
    if (keyframe == nullptr) return {};
    for (const Covisible& c : keyframe->covisibles) connected.push_back(c.keyframe);
    neighbors = keyframe->BestCovisibles(std::numeric_limits<int>::max(), options_.min_shared_points);
  }
  float min_score = std::numeric_limits<float>::max();
  for (const KeyFrameId id : neighbors) {
    if (const auto theirs = places_.Find(id)) min_score = std::min(min_score, Score(words.bow, theirs->bow));
  }
  std::vector<KeyFrameId> similar;
  if (min_score == std::numeric_limits<float>::max()) return similar;  // nothing to compare with
  for (const KeyFrameIndex::Candidate& candidate : places_.Query(words.bow, connected)) {
    if (candidate.score >= min_score) similar.push_back(candidate.id);
  }
  return similar;
}

LoopDetector::Group LoopDetector::MakeGroup(const MapData& map, KeyFrameId candidate) const {
  const auto neighbors =
      map.Find(candidate)->BestCovisibles(std::numeric_limits<int>::max(), options_.min_shared_points);
  Group group{{neighbors.begin(), neighbors.end()}, 1};
  group.members.insert(candidate);
  return group;
}

}  // namespace orbslam
