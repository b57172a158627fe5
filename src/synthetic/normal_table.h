// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "orbslam/util/random.h"

namespace orbslam {

/// Normal values at the price of a lookup: a table of 4096, of mean 0 and variance 1 exactly, read in random
/// order, five from each random word. A frame needs more than a million.
class NormalStream {
 public:
  explicit NormalStream(Rng* rng) : rng_(rng) {}

  float Next() {
    if (left_ == 0) bits_ = (*rng_)(), left_ = 5;
    const float value = Table()[bits_ & (kSize - 1)];
    bits_ >>= 12, --left_;
    return value;
  }

 private:
  static constexpr int kSize = 1 << 12;
  static const std::array<float, kSize>& Table();

  Rng* rng_;
  uint64_t bits_ = 0;
  int left_ = 0;
};

}  // namespace orbslam
