// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "orbslam/features/descriptor.h"
#include "orbslam/util/random.h"

namespace orbslam {

struct ClusterOptions {
  int num_clusters = 10;  // at most 255
  int max_iterations = 10;
  int num_threads = 1;  // the result does not depend on it
};

struct HammingClusters {
  std::vector<Descriptor> centers;  // at most num_clusters, fewer when there are fewer different descriptors
  std::vector<uint8_t>
      labels;  // one a descriptor: its nearest centre, ties to the first; every centre has some
};

/// k-means for binary vectors: centres are majority votes of the bits (k-majority, Grana et al., ICPR 2013),
/// seeded as in k-means++ (Arthur and Vassilvitskii, SODA 2007) with squared Hamming distances. descriptors
/// must not be empty.
HammingClusters ClusterDescriptors(std::span<const Descriptor> descriptors, const ClusterOptions& options,
                                   Rng rng);

}  // namespace orbslam
