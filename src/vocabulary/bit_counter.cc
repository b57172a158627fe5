// SPDX-License-Identifier: GPL-3.0-or-later
#include "bit_counter.h"

#include <cstddef>

namespace orbslam {
namespace {

/// Byte j of entry v is bit j of v.
constexpr std::array<uint64_t, 256> MakeSpread() {
  std::array<uint64_t, 256> spread{};
  for (uint64_t value = 0; value < 256; ++value) {
    for (int bit = 0; bit < 8; ++bit) spread[value] |= (value >> bit & 1) << (8 * bit);
  }
  return spread;
}
constexpr std::array<uint64_t, 256> kSpread = MakeSpread();

}  // namespace

void BitCounter::Add(const Descriptor& descriptor) {
  for (size_t byte = 0; byte < 32; ++byte) {
    packed_[byte] += kSpread[descriptor.words[byte / 8] >> (8 * (byte % 8)) & 0xFF];
  }
  ++size_;
  if (++in_packed_ == 255) Flush();
}

void BitCounter::Add(BitCounter other) {
  other.Flush();
  for (size_t bit = 0; bit < counts_.size(); ++bit) counts_[bit] += other.counts_[bit];
  size_ += other.size_;
}

void BitCounter::Flush() {
  for (size_t bit = 0; bit < counts_.size(); ++bit) {
    counts_[bit] += static_cast<uint32_t>(packed_[bit / 8] >> (8 * (bit % 8)) & 0xFF);
  }
  packed_.fill(0);
  in_packed_ = 0;
}

Descriptor BitCounter::Majority(const Descriptor& tie) {
  Flush();
  Descriptor majority;
  for (size_t bit = 0; bit < counts_.size(); ++bit) {
    const uint64_t twice = uint64_t{2} * counts_[bit];
    const uint64_t value = twice == size_ ? tie.words[bit / 64] >> (bit % 64) & 1 : (twice > size_ ? 1 : 0);
    majority.words[bit / 64] |= value << (bit % 64);
  }
  return majority;
}

}  // namespace orbslam
