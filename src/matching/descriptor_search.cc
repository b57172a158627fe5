// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/descriptor_search.h"

#include "assignment.h"

namespace orbslam {

bool IsDistinct(const NearestTwo& nearest, const DescriptorSearchOptions& options) {
  return nearest.index >= 0 && nearest.distance <= options.max_distance &&
         nearest.distance <= options.max_ratio * nearest.second_distance;
}

std::vector<int> SearchByDescriptor(const FrameFeatures& from, std::span<const int> from_indices,
                                    const FrameFeatures& to, std::span<const int> to_indices,
                                    const DescriptorSearchOptions& options) {
  Assignment assignment(static_cast<int>(from_indices.size()), to.size());
  for (int q = 0; q < std::ssize(from_indices); ++q) {
    const NearestTwo nearest = FindNearestTwo(from.descriptors[from_indices[q]], to.descriptors, to_indices);
    if (IsDistinct(nearest, options)) assignment.Offer(q, nearest.index, nearest.distance);
  }
  if (options.check_orientation) {
    assignment.RejectOddRotations(to, [&](int q) { return from.angles_deg[from_indices[q]]; });
  }
  return assignment.Take();
}

}  // namespace orbslam
