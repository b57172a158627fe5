// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/features/frame_features.h"
#include "support/random.h"

namespace orbslam::test {

inline constexpr ImageBounds kImage{0, 0, 640, 480};

inline float RandomFloat(Rng* rng, double lo, double hi) { return static_cast<float>(rng->Uniform(lo, hi)); }

/// Keypoints anywhere, half of them with depth, with descriptors that differ from one of a few by some bits,
/// so that there are always close rivals.
inline FrameFeatures RandomFeatures(int count, Rng* rng) {
  std::vector<Descriptor> prototypes;
  for (int i = 0; i < 5; ++i) prototypes.push_back(RandomDescriptor(rng));
  FrameFeatures features;
  for (int i = 0; i < count; ++i) {
    features.pixels.emplace_back(RandomFloat(rng, 0, 640), RandomFloat(rng, 0, 480));
    features.angles_deg.push_back(RandomFloat(rng, 0, 360));
    features.levels.push_back(static_cast<int>(rng->Below(8)));
    features.descriptors.push_back(WithNoise(prototypes[rng->Below(5)], 60, rng));
    const bool has_depth = rng->Below(2) == 0;
    features.depths_m.push_back(has_depth ? 2.0f : -1.0f);
    features.right_u.push_back(has_depth ? features.pixels[i].x - 20 : -1.0f);
  }
  features.grid = FeatureGrid(features.pixels, kImage);
  return features;
}

}  // namespace orbslam::test
