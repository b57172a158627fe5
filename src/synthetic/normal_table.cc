// SPDX-License-Identifier: GPL-3.0-or-later
#include "normal_table.h"

#include <cmath>

namespace orbslam {

const std::array<float, NormalStream::kSize>& NormalStream::Table() {
  static const auto table = [] {
    std::array<double, kSize> values;
    Rng rng(0, 0, 0x6E6F726D);
    double squares = 0;
    for (int i = 0; i < kSize; i += 2) {  // in pairs of opposites: the mean is 0
      values[i] = rng.Gaussian(), values[i + 1] = -values[i];
      squares += 2 * values[i] * values[i];
    }
    std::array<float, kSize> result;
    for (int i = 0; i < kSize; ++i) result[i] = static_cast<float>(values[i] / std::sqrt(squares / kSize));
    return result;
  }();
  return table;
}

}  // namespace orbslam
