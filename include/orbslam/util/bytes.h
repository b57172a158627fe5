// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace orbslam {

// For binary files, which are written and read as they lie in memory.
static_assert(std::endian::native == std::endian::little, "binary files are little-endian");

/// One to one in either argument when the other is fixed: a change of a single word always changes the
/// result.
inline uint64_t MixChecksum(uint64_t hash, uint64_t word) {
  return std::rotl((hash ^ word) * 0x9E3779B97F4A7C15u, 29);
}

/// Finds damage by accident, not by intent. At about the speed of memory; the same on every machine.
uint64_t Checksum(std::span<const std::byte> bytes);

template <class T>
void AppendBytes(std::span<const T> items, std::string* bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes->append(reinterpret_cast<const char*>(items.data()), items.size_bytes());
}

/// Fills items with the front of bytes and drops it there. False if there are too few: nothing happens then,
/// and in particular nothing is allocated for a count that the file does not keep.
template <class T>
[[nodiscard]] bool TakeBytes(size_t count, std::vector<T>* items, std::string_view* bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (count > bytes->size() / sizeof(T)) return false;
  items->resize(count);
  if (count > 0) std::memcpy(static_cast<void*>(items->data()), bytes->data(), count * sizeof(T));
  bytes->remove_prefix(count * sizeof(T));
  return true;
}

template <class T>
[[nodiscard]] bool TakeBytes(T* item, std::string_view* bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (bytes->size() < sizeof(T)) return false;
  std::memcpy(static_cast<void*>(item), bytes->data(), sizeof(T));
  bytes->remove_prefix(sizeof(T));
  return true;
}

}  // namespace orbslam
