// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/random.h"

#include <cmath>
#include <numbers>

namespace orbslam {

double Rng::Gaussian() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * Uniform());
}

}  // namespace orbslam
