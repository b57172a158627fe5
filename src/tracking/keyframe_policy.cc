// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/keyframe_policy.h"

namespace orbslam {

bool NeedsKeyFrame(const KeyFrameEvidence& evidence, const KeyFramePolicyOptions& options) {
  const bool lacks_close = evidence.num_tracked_close < options.min_tracked_close &&
                           evidence.num_untracked_close > options.min_untracked_close;
  const double min_ratio =
      evidence.num_keyframes < 2 ? options.min_tracked_ratio_young : options.min_tracked_ratio;
  const bool sees_new = lacks_close || evidence.num_inliers < min_ratio * evidence.num_reference_points;
  if (!sees_new || evidence.num_inliers <= options.min_inliers) return false;
  const bool is_weak =
      lacks_close || evidence.num_inliers < options.weak_tracked_ratio * evidence.num_reference_points;
  const bool is_overdue = evidence.since_last_keyframe_s >= options.max_interval_s;
  return evidence.is_mapper_idle || is_overdue || is_weak;
}

}  // namespace orbslam
