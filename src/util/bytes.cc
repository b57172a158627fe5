// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/bytes.h"

namespace orbslam {

/// Four independent lanes of 8 bytes, for the processor to work on at once.
uint64_t Checksum(std::span<const std::byte> bytes) {
  uint64_t lanes[4] = {1, 2, 3, 4};
  uint64_t block[4];
  const size_t whole = bytes.size() / sizeof(block) * sizeof(block);
  const auto mix_block = [&] {
    for (int i = 0; i < 4; ++i) lanes[i] = MixChecksum(lanes[i], block[i]);
  };
  for (size_t at = 0; at < whole; at += sizeof(block)) {
    std::memcpy(block, bytes.data() + at, sizeof(block));
    mix_block();
  }
  std::memset(block, 0, sizeof(block));
  if (whole < bytes.size()) std::memcpy(block, bytes.data() + whole, bytes.size() - whole);
  mix_block();
  uint64_t hash = bytes.size();
  for (const uint64_t lane : lanes) hash = MixChecksum(hash, lane);
  return hash;
}

}  // namespace orbslam
