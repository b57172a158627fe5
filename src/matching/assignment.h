// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/features/frame_features.h"
#include "orbslam/matching/orientation_check.h"

namespace orbslam {

/// Collects matches query -> keypoint so that every keypoint goes to the query that is nearest to it.
class Assignment {
 public:
  Assignment(int num_queries, int num_keypoints)
      : match_(num_queries, -1), owner_(num_keypoints, -1), distance_(num_keypoints, 257) {}

  void Offer(int query, int keypoint, int distance) {
    if (distance >= distance_[keypoint]) return;
    if (owner_[keypoint] >= 0) match_[owner_[keypoint]] = -1;
    owner_[keypoint] = query;
    distance_[keypoint] = distance;
    match_[query] = keypoint;
  }

  /// Takes back the matches that disagree with the others on how the camera rolled. query_angle_deg(query) < 0: no
  /// angle known.
  template <class QueryAngle>
  void RejectOddRotations(const FrameFeatures& features, QueryAngle query_angle_deg) {
    OrientationCheck check;
    for (int query = 0; query < std::ssize(match_); ++query) {
      const float angle_deg = match_[query] >= 0 ? query_angle_deg(query) : -1.0f;
      if (angle_deg >= 0) check.Add(query, angle_deg, features.angles_deg[match_[query]]);
    }
    for (const int query : check.Outliers()) match_[query] = -1;
  }

  /// For each query its keypoint, or -1.
  std::vector<int> Take() { return std::move(match_); }

 private:
  std::vector<int> match_;     // one a query
  std::vector<int> owner_;     // one a keypoint
  std::vector<int> distance_;  // of the owner
};

}  // namespace orbslam
