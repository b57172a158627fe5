// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

namespace orbslam {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): small, fast, and the same on every machine. Seeded from
/// what it is for, (seed, frame, purpose), so that results do not depend on who drew before.
class Rng {
 public:
  using result_type = uint64_t;

  explicit Rng(uint64_t seed, uint64_t frame = 0, uint64_t purpose = 0)
      : state_(seed ^ Mixed(frame * 0xD6E8FEB86659FD93u) ^ Mixed(purpose * 0xC2B2AE3D27D4EB4Fu)) {}

  static constexpr uint64_t min() { return 0; }
  static constexpr uint64_t max() { return std::numeric_limits<uint64_t>::max(); }

  uint64_t operator()() {
    state_ += 0x9E3779B97F4A7C15u;
    return Mixed(state_);
  }

  /// Uniform in [0, n), n > 0.
  uint32_t Below(uint32_t n) { return static_cast<uint32_t>(((*this)() >> 32) * n >> 32); }
  /// Uniform in [lo, hi).
  double Uniform(double lo = 0.0, double hi = 1.0) {
    return lo + (hi - lo) * static_cast<double>((*this)() >> 11) * 0x1.0p-53;
  }
  /// Normal with mean 0 and standard deviation 1 (Box-Muller).
  double Gaussian();

 private:
  /// A bijection that keeps 0. Mixes keys too: states that differ by a multiple of the step are one stream,
  /// shifted.
  static uint64_t Mixed(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  uint64_t state_;
};

}  // namespace orbslam
