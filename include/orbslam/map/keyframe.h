// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "orbslam/features/frame_features.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/util/ids.h"

namespace orbslam {

/// Another keyframe that sees some of the same points.
struct Covisible {
  KeyFrameId keyframe;
  int num_shared_points = 0;

  friend bool operator==(const Covisible&, const Covisible&) = default;
};

/// A frame that the map is built of.
struct KeyFrame {
  KeyFrameId id;
  FrameId frame_id;
  double timestamp_s = 0;
  Rigid3d camera_from_world;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<MapPointId> points;  // one a keypoint; invalid: none
  std::vector<Covisible>
      covisibles;     // ascending in id; exact: every edit of an observation keeps it up to date
  KeyFrameId parent;  // in the spanning tree; invalid: the root
  std::set<KeyFrameId> children;
  std::set<KeyFrameId> loop_edges;  // never culled while it has any

  Eigen::Vector3d CenterWorld() const { return Inverse(camera_from_world).translation; }
  /// Those that share at least min_shared points, most first (ties: older first), at most max_count.
  std::vector<KeyFrameId> BestCovisibles(int max_count, int min_shared = 15) const;
};

/// What a culled keyframe leaves behind, so that trajectories that refer to it stay expressible.
struct KeyFrameRemains {
  KeyFrameId parent;
  Rigid3d self_from_parent;
};

}  // namespace orbslam
