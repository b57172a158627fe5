// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/map/keyframe.h"

#include <algorithm>

namespace orbslam {

std::vector<KeyFrameId> KeyFrame::BestCovisibles(int max_count, int min_shared) const {
  std::vector<Covisible> good;
  std::ranges::copy_if(covisibles, std::back_inserter(good),
                       [&](const Covisible& c) { return c.num_shared_points >= min_shared; });
  std::ranges::stable_sort(good, std::ranges::greater{}, &Covisible::num_shared_points);
  if (std::ssize(good) > max_count) good.resize(max_count);
  std::vector<KeyFrameId> ids;
  std::ranges::transform(good, std::back_inserter(ids), &Covisible::keyframe);
  return ids;
}

}  // namespace orbslam
