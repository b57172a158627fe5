// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/keyframe_policy.h"

#include <algorithm>

namespace orbslam {

KeyFrameEvidence GatherKeyFrameEvidence(const Sensor& sensor, const MapData& map, const Frame& frame,
                                        KeyFrameId reference) {
  KeyFrameEvidence evidence;
  const double close_limit_m = sensor.depth.CloseLimitM(sensor.camera.fx);
  for (int i = 0; i < frame.features->size(); ++i) {
    const float depth_m = frame.features->depths_m[i];
    if (depth_m <= 0 || depth_m > close_limit_m) continue;
    ++(frame.points[i].IsValid() ? evidence.num_tracked_close : evidence.num_untracked_close);
  }
  for (const MapPointId id : map.Find(map.Resolve(reference))->points) {
    if (!id.IsValid()) continue;
    ++evidence.num_reference_points;
    evidence.num_shared_points += map.Find(id)->NumObservations() > 1;
  }
  return evidence;
}

bool NeedsKeyFrame(const KeyFrameEvidence& evidence, const KeyFramePolicyOptions& options) {
  const bool lacks_close = evidence.num_tracked_close < options.min_tracked_close &&
                           evidence.num_untracked_close > options.min_untracked_close;
  const int num_points = evidence.num_reference_points + evidence.num_erased_points;
  const double num_expected = std::max(options.min_tracked_ratio * evidence.num_shared_points,
                                       options.min_tracked_ratio_all * num_points);
  const bool sees_new = lacks_close || evidence.num_inliers < num_expected;
  if (!sees_new || evidence.num_inliers <= options.min_inliers) return false;
  const bool is_weak = lacks_close || evidence.num_inliers < options.weak_share * num_expected;
  const bool is_overdue = evidence.since_last_keyframe_s >= options.max_interval_s;
  return evidence.is_mapper_idle || is_overdue || is_weak;
}

}  // namespace orbslam
