// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/messages.h"

namespace orbslam {

const char* Name(TrackingState state) {
  switch (state) {
    case TrackingState::kNotInitialized:
      return "NOT_INITIALIZED";
    case TrackingState::kOk:
      return "OK";
    case TrackingState::kLost:
      return "LOST";
  }
  return "?";
}

}  // namespace orbslam
