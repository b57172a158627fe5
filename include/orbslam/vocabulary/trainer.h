// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "orbslam/features/descriptor.h"
#include "orbslam/util/result.h"
#include "orbslam/vocabulary/vocabulary.h"

namespace orbslam {

struct TrainerOptions {
  int branching = 10;       // k, 2 to 255
  int depth = 5;            // L: up to k^L words
  int max_iterations = 10;  // of the clustering of each node; it stops earlier when nothing changes
  uint64_t seed = 1;
  int num_threads = 1;  // the result does not depend on it
  std::function<void(int level, int num_nodes)>
      on_level;  // after each level, on the calling thread; may be empty
};

/// Grows a vocabulary from the top: the descriptors of a node are clustered into k children, and so on for L
/// levels (Nister and Stewenius, CVPR 2006). A node whose descriptors are all the same stays a word. The
/// weight of a word is its inverse document frequency ln(images / images with the word). images: the
/// descriptors of each. Error when the options are out of range or there are no two different descriptors.
Result<Vocabulary> TrainVocabulary(std::span<const std::vector<Descriptor>> images,
                                   const TrainerOptions& options);

}  // namespace orbslam
