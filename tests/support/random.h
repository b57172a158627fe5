// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/features/descriptor.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/geometry/so3.h"
#include "orbslam/util/random.h"

namespace orbslam::test {

/// Normal in each component.
inline Eigen::Vector3d RandomVector(Rng* rng, double sigma) {
  return sigma * Eigen::Vector3d(rng->Gaussian(), rng->Gaussian(), rng->Gaussian());
}

inline Eigen::Vector3d RandomDirection(Rng* rng) { return RandomVector(rng, 1).normalized(); }

/// Rotation by up to max_angle_rad about any axis, translation by up to max_distance_m in any direction.
inline Rigid3d RandomMotion(Rng* rng, double max_angle_rad = 3, double max_distance_m = 2) {
  return {So3Exp(rng->Uniform(0, max_angle_rad) * RandomDirection(rng)),
          rng->Uniform(0, max_distance_m) * RandomDirection(rng)};
}

inline Descriptor RandomDescriptor(Rng* rng) {
  Descriptor descriptor;
  for (uint64_t& word : descriptor.words) word = (*rng)();
  return descriptor;
}

/// Flips up to num_bits bits.
inline Descriptor WithNoise(Descriptor descriptor, int num_bits, Rng* rng) {
  for (int i = 0; i < num_bits; ++i) descriptor.words[rng->Below(4)] ^= uint64_t{1} << rng->Below(64);
  return descriptor;
}

}  // namespace orbslam::test
