// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include "orbslam/util/ids.h"

namespace orbslam {

/// Finds the map points that were made on something before it was known to move. A point that a moving object
/// shows in several frames, while no frame finds it off the mask, is condemned.
class Quarantine {
 public:
  /// Frames that must show a point on a moving object: one may be a wrong mask, or a chance meeting of
  /// depths.
  static constexpr int kMinFrames = 3;

  void ShownOnMovingObject(MapPointId id);
  /// Found on what does not move: the point starts anew.
  void FoundStatic(MapPointId id) { frames_.erase(id); }

  /// The points to erase, ascending; forgets them.
  std::vector<MapPointId> TakeCondemned();

 private:
  std::unordered_map<MapPointId, int> frames_;
  std::vector<MapPointId> condemned_;
};

}  // namespace orbslam
