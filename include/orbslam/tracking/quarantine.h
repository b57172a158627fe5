// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include "orbslam/util/ids.h"

namespace orbslam {

/// Finds the map points that were made on something before it was known to move. A point that several frames
/// refute, while none finds it on what does not move, is condemned.
class Quarantine {
 public:
  /// Frames that must refute a point: one may be a wrong mask, or a chance meeting of depths.
  static constexpr int kMinFrames = 3;

  /// A frame shows the point on a moving object, or nothing where it should be.
  void Refute(MapPointId id);
  /// Found on what does not move: the point starts anew.
  void FoundStatic(MapPointId id) { frames_.erase(id); }

  /// The points to erase, ascending; forgets them.
  std::vector<MapPointId> TakeCondemned();

 private:
  std::unordered_map<MapPointId, int> frames_;
  std::vector<MapPointId> condemned_;
};

}  // namespace orbslam
