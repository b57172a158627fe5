// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_reviser.h"

#include <algorithm>
#include <utility>

namespace orbslam {

void PoseReviser::Retract(std::vector<MapPointId> points, double since_s) {
  std::ranges::sort(points);
  for (auto frame = kept_.rbegin(); frame != kept_.rend() && frame->timestamp_s > since_s; ++frame)
    std::erase_if(frame->sightings, [&](const Sighting& sighting) {
      return std::ranges::binary_search(points, sighting.point);
    });
}

std::vector<PastFrame> PoseReviser::ReviseUntil(double timestamp_s) {
  std::vector<PastFrame> revised;
  while (!kept_.empty() && kept_.front().timestamp_s <= timestamp_s) {
    if (FindPoseAgain(map_, sensor_, &kept_.front())) revised.push_back(std::move(kept_.front()));
    kept_.pop_front();
  }
  return revised;
}

}  // namespace orbslam
