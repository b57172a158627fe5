// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/pipeline/messages.h"

namespace orbslam {

/// Counts, between two keyframes, how often each map point was in view and how often it was found. Kept here
/// and handed over with the next keyframe, so that tracking a frame never writes to the map.
class PointCounter {
 public:
  void CountVisible(MapPointId id) { ++Slot(id).times_visible; }
  void CountFound(MapPointId id) { ++Slot(id).times_found; }

  /// All that was counted, ascending in id; starts again from nothing.
  std::vector<PointStatistics> Take();

 private:
  PointStatistics& Slot(MapPointId id);

  std::vector<int> slot_of_point_;  // index: id; -1: not counted yet
  std::vector<PointStatistics> slots_;
};

}  // namespace orbslam
