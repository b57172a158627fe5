// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_reviser.h"

#include <utility>

#include "orbslam/tracking/pose_refinement.h"

namespace orbslam {
namespace {

constexpr double kMinLeft = 0.5;  // of the matches: fewer hold a pose worse than all of them did

}  // namespace

void PoseReviser::Keep(Frame frame, KeyFrameId reference, const Rigid3d& camera_from_reference) {
  kept_.push_back({std::move(frame), reference, camera_from_reference});
}

std::vector<RevisedPose> PoseReviser::ReviseUntil(double timestamp_s) {
  std::vector<RevisedPose> revised;
  while (!kept_.empty() && kept_.front().frame.timestamp_s <= timestamp_s) {
    if (const auto pose = Revise(std::move(kept_.front()))) revised.push_back(*pose);
    kept_.pop_front();
  }
  return revised;
}

std::optional<RevisedPose> PoseReviser::Revise(Kept kept) const {
  Rigid3d reference_from_world;
  uint64_t epoch = 0;
  {
    const auto guard = map_.Read();
    epoch = guard->epoch();
    const auto found = guard->CameraFromWorld(kept.reference);
    const KeyFrame* reference = guard->Find(kept.reference);
    // A keyframe's own pose has been adjusted together with the map.
    if (!found || (reference != nullptr && reference->frame_id == kept.frame.id)) return std::nullopt;
    reference_from_world = *found;
  }
  kept.frame.camera_from_world = kept.camera_from_reference * reference_from_world;
  const double num_first = kept.frame.NumPoints();
  const int num_left = RefinePose(map_, sensor_, &kept.frame);
  const bool map_has_moved = map_.Read()->epoch() != epoch;  // and not the reference's pose that we took
  if (map_has_moved || num_left < kMinLeft * num_first) return std::nullopt;
  return RevisedPose{kept.frame.id, kept.frame.camera_from_world * Inverse(reference_from_world),
                     kept.frame.pose_information};
}

}  // namespace orbslam
