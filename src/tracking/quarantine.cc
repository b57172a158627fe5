// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/quarantine.h"

#include <algorithm>
#include <utility>

namespace orbslam {

void Quarantine::Refute(MapPointId id) {
  if (++frames_[id] < kMinFrames) return;
  frames_.erase(id);
  condemned_.push_back(id);
}

std::vector<MapPointId> Quarantine::TakeCondemned() {
  std::ranges::sort(condemned_);
  return std::exchange(condemned_, {});
}

}  // namespace orbslam
