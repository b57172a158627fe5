// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_reviser.h"

#include <utility>

namespace orbslam {

std::vector<PastFrame> PoseReviser::ReviseUntil(double timestamp_s) {
  std::vector<PastFrame> revised;
  while (!kept_.empty() && kept_.front().timestamp_s <= timestamp_s) {
    if (FindPoseAgain(map_, sensor_, &kept_.front())) revised.push_back(std::move(kept_.front()));
    kept_.pop_front();
  }
  return revised;
}

}  // namespace orbslam
