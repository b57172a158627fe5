// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace orbslam {

/// 256 bits of steered BRIEF (Rublee et al., "ORB", ICCV 2011). Byte i of the 32 is byte i of OpenCV's row.
struct alignas(32) Descriptor {
  std::array<uint64_t, 4> words{};

  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// Number of bits that differ, 0 to 256.
int HammingDistance(const Descriptor& a, const Descriptor& b);

/// The best and the second-best of some candidates; ties go to the first. index is -1 when there is none.
struct NearestTwo {
  int index = -1;
  int distance = 257;
  int second_index = -1;
  int second_distance = 257;
};

/// Compares query with database[i] for every i in candidates. index and second_index are such i.
NearestTwo FindNearestTwo(const Descriptor& query, std::span<const Descriptor> database,
                          std::span<const int> candidates);

/// The same over all of the database.
NearestTwo FindNearestTwo(const Descriptor& query, std::span<const Descriptor> database);

/// Index of the descriptor with the least median distance to all others: the one that stands for a set
/// (ORB-SLAM, Mur-Artal et al. 2015, section III-C). set must not be empty.
int MedoidIndex(std::span<const Descriptor> set);

}  // namespace orbslam
