// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <vector>

#include "orbslam/loop/loop_options.h"
#include "orbslam/map/map.h"
#include "orbslam/pipeline/place_index.h"

namespace orbslam {

/// Have we been here before? Candidates look more alike than the least similar neighbour, are not connected
/// with the keyframe, and the keyframes just before saw their surroundings too. (ORB-SLAM, section VII-A.)
class LoopDetector {
 public:
  LoopDetector(const LoopOptions& options, const Map& map, const PlaceIndex& places)
      : options_(options), map_(map), places_(places) {}

  /// To be asked for every keyframe in turn. words: the keyframe's own.
  std::vector<KeyFrameId> Detect(KeyFrameId keyframe, const PlaceIndex::Words& words);
  void Forget() { groups_.clear(); }

 private:
  /// A candidate with its neighbours, and for how many keyframes in a row something of it was seen.
  struct Group {
    std::set<KeyFrameId> members;
    int consistency = 1;
  };
  std::vector<KeyFrameId> FindSimilar(KeyFrameId keyframe, const PlaceIndex::Words& words) const;
  Group MakeGroup(const MapData& map, KeyFrameId candidate) const;

  const LoopOptions& options_;
  const Map& map_;
  const PlaceIndex& places_;
  std::vector<Group> groups_;  // of the last keyframe
};

}  // namespace orbslam
