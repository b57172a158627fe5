// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/word_search.h"

#include <algorithm>

#include "assignment.h"

namespace orbslam {
namespace {

bool TakesPart(const std::vector<char>& takes_part, int i) { return takes_part.empty() || takes_part[i]; }

}  // namespace

std::vector<int> SearchByWords(const FrameFeatures& from, const DirectIndex& from_index,
                               const std::vector<char>& takes_part_from, const FrameFeatures& to,
                               const DirectIndex& to_index, const std::vector<char>& takes_part_to,
                               const DescriptorSearchOptions& options) {
  Assignment assignment(from.size(), to.size());
  std::vector<int> candidates;
  for (size_t f = 0, t = 0; f < from_index.size() && t < to_index.size();) {
    if (from_index.nodes[f] != to_index.nodes[t]) {
      from_index.nodes[f] < to_index.nodes[t] ? ++f : ++t;
      continue;
    }
    candidates.clear();
    std::ranges::copy_if(to_index.FeaturesOf(t++), std::back_inserter(candidates),
                         [&](int i) { return TakesPart(takes_part_to, i); });
    for (const int i : from_index.FeaturesOf(f++)) {
      if (!TakesPart(takes_part_from, i)) continue;
      const NearestTwo nearest = FindNearestTwo(from.descriptors[i], to.descriptors, candidates);
      if (IsDistinct(nearest, options)) assignment.Offer(i, nearest.index, nearest.distance);
    }
  }
  if (options.check_orientation) assignment.RejectOddRotations(to, [&](int i) { return from.angles_deg[i]; });
  return assignment.Take();
}

}  // namespace orbslam
