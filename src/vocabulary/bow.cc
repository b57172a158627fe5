// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/bow.h"

#include <algorithm>

namespace orbslam {

float Score(const BowVector& a, const BowVector& b) {
  float common = 0;
  auto in_a = a.begin();
  auto in_b = b.begin();
  while (in_a != a.end() && in_b != b.end()) {
    if (in_a->word < in_b->word) {
      ++in_a;
    } else if (in_b->word < in_a->word) {
      ++in_b;
    } else {
      common += std::min((in_a++)->weight, (in_b++)->weight);
    }
  }
  return std::min(common, 1.0F);  // the weights of equal vectors may add up to a little more than 1
}

}  // namespace orbslam
