// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/descriptor.h"

#include <algorithm>
#include <vector>

#include "cpu.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

// Every loop exists twice, with the popcnt instruction and without; the macro keeps them one text. Without
// the target attribute, std::popcount becomes a call for each word.
#define ORBSLAM_POPCOUNT_TARGET __attribute__((target("popcnt")))

inline __attribute__((always_inline)) int CountDifferent(const Descriptor& a, const Descriptor& b) {
  int bits = 0;
  for (int i = 0; i < 4; ++i) bits += std::popcount(a.words[i] ^ b.words[i]);
  return bits;
}

inline __attribute__((always_inline)) void Offer(int index, int distance, NearestTwo* nearest) {
  if (distance < nearest->distance) {
    nearest->second_index = nearest->index;
    nearest->second_distance = nearest->distance;
    nearest->index = index;
    nearest->distance = distance;
  } else if (distance < nearest->second_distance) {
    nearest->second_index = index;
    nearest->second_distance = distance;
  }
}

inline __attribute__((always_inline)) NearestTwo NearestOf(const Descriptor& query,
                                                           const Descriptor* database,
                                                           std::span<const int> candidates) {
  NearestTwo nearest;
  for (const int i : candidates) Offer(i, CountDifferent(query, database[i]), &nearest);
  return nearest;
}

inline __attribute__((always_inline)) NearestTwo NearestOfAll(const Descriptor& query,
                                                              std::span<const Descriptor> database) {
  NearestTwo nearest;
  for (int i = 0; i < static_cast<int>(database.size()); ++i)
    Offer(i, CountDifferent(query, database[i]), &nearest);
  return nearest;
}

// distances: n x n, row major; the diagonal stays as it is.
inline __attribute__((always_inline)) void AllDistances(std::span<const Descriptor> set,
                                                        uint16_t* distances) {
  const size_t n = set.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 1; j < n; ++j) {
      distances[i * n + j] = distances[j * n + i] = static_cast<uint16_t>(CountDifferent(set[i], set[j]));
    }
  }
}

ORBSLAM_POPCOUNT_TARGET int CountDifferentPopcnt(const Descriptor& a, const Descriptor& b) {
  return CountDifferent(a, b);
}
ORBSLAM_POPCOUNT_TARGET NearestTwo NearestOfPopcnt(const Descriptor& query, const Descriptor* database,
                                                   std::span<const int> candidates) {
  return NearestOf(query, database, candidates);
}
ORBSLAM_POPCOUNT_TARGET NearestTwo NearestOfAllPopcnt(const Descriptor& query,
                                                      std::span<const Descriptor> database) {
  return NearestOfAll(query, database);
}
ORBSLAM_POPCOUNT_TARGET void AllDistancesPopcnt(std::span<const Descriptor> set, uint16_t* distances) {
  AllDistances(set, distances);
}

const bool kHasPopcnt = HasPopcnt();

}  // namespace

int HammingDistance(const Descriptor& a, const Descriptor& b) {
  return kHasPopcnt ? CountDifferentPopcnt(a, b) : CountDifferent(a, b);
}

NearestTwo FindNearestTwo(const Descriptor& query, std::span<const Descriptor> database,
                          std::span<const int> candidates) {
  return kHasPopcnt ? NearestOfPopcnt(query, database.data(), candidates)
                    : NearestOf(query, database.data(), candidates);
}

NearestTwo FindNearestTwo(const Descriptor& query, std::span<const Descriptor> database) {
  return kHasPopcnt ? NearestOfAllPopcnt(query, database) : NearestOfAll(query, database);
}

int MedoidIndex(std::span<const Descriptor> set) {
  ORBSLAM_CHECK(!set.empty());
  const size_t n = set.size();
  if (n <= 2) return 0;
  std::vector<uint16_t> distances(n * n);
  kHasPopcnt ? AllDistancesPopcnt(set, distances.data()) : AllDistances(set, distances.data());
  // A row's zero for the descriptor itself comes first, so the (lower) median of the others is one further.
  const size_t median = 1 + (n - 2) / 2;
  size_t best = 0;
  int best_distance = 257;
  for (size_t i = 0; i < n; ++i) {
    const auto row = distances.begin() + static_cast<std::ptrdiff_t>(i * n);
    std::nth_element(row, row + static_cast<std::ptrdiff_t>(median), row + static_cast<std::ptrdiff_t>(n));
    if (row[static_cast<std::ptrdiff_t>(median)] >= best_distance) continue;
    best_distance = row[static_cast<std::ptrdiff_t>(median)];
    best = i;
  }
  return static_cast<int>(best);
}

}  // namespace orbslam
