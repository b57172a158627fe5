// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearest_child.h"

#include <bit>

namespace orbslam {
namespace {

// Always inlined, so that it is compiled for the instructions of the function that it ends up in.
[[gnu::always_inline]] inline uint32_t Nearest(const Descriptor& query, const Descriptor* children,
                                               uint32_t count) {
  uint32_t best = 0;
  int best_distance = 257;
  for (uint32_t i = 0; i < count; ++i) {
    int distance = 0;
    for (size_t word = 0; word < 4; ++word) {
      distance += __builtin_popcountll(query.words[word] ^ children[i].words[word]);
    }
    if (distance < best_distance) {
      best = i;
      best_distance = distance;
    }
  }
  return best;
}

uint32_t NearestPortable(const Descriptor& query, const Descriptor* children, uint32_t count) {
  return Nearest(query, children, count);
}

#if defined(__x86_64__)
[[gnu::target("popcnt")]] uint32_t NearestPopcnt(const Descriptor& query, const Descriptor* children,
                                                 uint32_t count) {
  return Nearest(query, children, count);
}
#endif

NearestChildFunction Choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("popcnt")) return NearestPopcnt;
#endif
  return NearestPortable;
}

}  // namespace

NearestChildFunction BestNearestChild() {
  static const NearestChildFunction best = Choose();
  return best;
}

}  // namespace orbslam
