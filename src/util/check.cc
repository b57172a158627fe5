// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/check.h"

#include <cstdio>
#include <cstdlib>

namespace orbslam {

void CheckFailed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: internal error: '%s' does not hold; please report it\n", file, line, condition);
  std::abort();
}

}  // namespace orbslam
