// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/point_counter.h"

#include <algorithm>

namespace orbslam {

PointStatistics& PointCounter::Slot(MapPointId id) {
  if (id.value >= slot_of_point_.size()) slot_of_point_.resize(2 * id.value + 1, -1);
  int& slot = slot_of_point_[id.value];
  if (slot < 0) {
    slot = static_cast<int>(slots_.size());
    slots_.push_back({id, 0, 0});
  }
  return slots_[slot];
}

std::vector<PointStatistics> PointCounter::Take() {
  for (const PointStatistics& s : slots_) slot_of_point_[s.point.value] = -1;
  std::vector<PointStatistics> taken = std::move(slots_);
  slots_.clear();
  std::ranges::sort(taken, {}, &PointStatistics::point);
  return taken;
}

}  // namespace orbslam
