// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/projection_search.h"

#include <cmath>

#include "assignment.h"

namespace orbslam {
namespace {

class Search {
 public:
  Search(const FrameFeatures& features, std::span<const char> is_taken,
         const ProjectionSearchOptions& options)
      : features_(features), is_taken_(is_taken), options_(options) {}

  NearestTwo Find(const ProjectionQuery& query) {
    features_.grid.Near(query.u, query.v, query.radius_px, features_.pixels, features_.levels,
                        query.min_level, query.max_level, &candidates_);
    std::erase_if(candidates_, [&](int i) { return !IsAllowed(query, i); });
    const NearestTwo nearest = FindNearestTwo(query.descriptor, features_.descriptors, candidates_);
    if (nearest.distance > options_.max_distance || IsAmbiguous(nearest)) return {};
    return nearest;
  }

 private:
  bool IsAllowed(const ProjectionQuery& query, int i) const {
    if (!is_taken_.empty() && is_taken_[i]) return false;
    const bool compares_right = query.right_u >= 0 && features_.right_u[i] >= 0;
    return !compares_right || std::abs(query.right_u - features_.right_u[i]) <= query.radius_px;
  }

  bool IsAmbiguous(const NearestTwo& nearest) const {
    return nearest.second_index >= 0 &&
           features_.levels[nearest.index] == features_.levels[nearest.second_index] &&
           nearest.distance > options_.max_ratio * nearest.second_distance;
  }

  const FrameFeatures& features_;
  std::span<const char> is_taken_;
  const ProjectionSearchOptions& options_;
  std::vector<int> candidates_;
};

}  // namespace

std::vector<int> SearchByProjection(std::span<const ProjectionQuery> queries, const FrameFeatures& features,
                                    std::span<const char> is_taken, const ProjectionSearchOptions& options) {
  Search search(features, is_taken, options);
  Assignment assignment(static_cast<int>(queries.size()), features.size());
  for (int q = 0; q < std::ssize(queries); ++q) {
    const NearestTwo nearest = search.Find(queries[q]);
    if (nearest.index >= 0) assignment.Offer(q, nearest.index, nearest.distance);
  }
  if (options.check_orientation) {
    assignment.RejectOddRotations(features, [&](int q) { return queries[q].angle_deg; });
  }
  return assignment.Take();
}

}  // namespace orbslam
