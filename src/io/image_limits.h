// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orbslam/util/result.h"

namespace orbslam {

/// Refuses a header that promises more than any RGB-D camera has, before memory is taken for it.
inline Status CheckImageSize(int64_t width, int64_t height) {
  constexpr int64_t kMaxSidePx = 16384;
  if (width > 0 && height > 0 && width <= kMaxSidePx && height <= kMaxSidePx) return OkStatus();
  return Error{"image of " + std::to_string(width) + " x " + std::to_string(height) +
               " px, allowed are 1 to " + std::to_string(kMaxSidePx) + " px a side"};
}

}  // namespace orbslam
