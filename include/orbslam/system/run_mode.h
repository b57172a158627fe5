// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/util/stage.h"

namespace orbslam {

/// How the stages of a system are run.
struct RunMode {
  bool is_sequential = false;  // all on the caller's thread, exactly repeatable
  bool is_live = false;        // never wait for the mapper or for a mask: skip what cannot be done in time

  StageMode OfStages() const { return is_sequential ? StageMode::kInline : StageMode::kThreaded; }
};

}  // namespace orbslam
