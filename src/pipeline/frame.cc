// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/frame.h"

#include <algorithm>

namespace orbslam {

int Frame::NumPoints() const { return static_cast<int>(std::ranges::count_if(points, &MapPointId::IsValid)); }

void Frame::ForgetPoints() {
  std::ranges::fill(points, MapPointId());
  moving_below_m = 0;
}

}  // namespace orbslam
