// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "orbslam/features/descriptor.h"

namespace orbslam {

/// How often each of the 256 bits is set in a set of descriptors.
class BitCounter {
 public:
  void Add(const Descriptor& descriptor);
  /// Adds another set.
  void Add(BitCounter other);

  uint32_t size() const { return size_; }
  /// The descriptor with the least sum of Hamming distances to the set: each bit as most have it, ties as in
  /// `tie`.
  Descriptor Majority(const Descriptor& tie);

 private:
  void Flush();

  std::array<uint64_t, 32> packed_{};  // 8 counters of 8 bits each, for speed; flushed before they overflow
  uint32_t in_packed_ = 0;
  std::array<uint32_t, 256> counts_{};
  uint32_t size_ = 0;
};

}  // namespace orbslam
