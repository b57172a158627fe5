// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

/// kPaper: the published algorithm alone (with ego-motion compensation). kFull: all evidence.
enum class DetectorMode { kFull, kPaper };

struct DynamicDetectorOptions {
  DetectorMode mode = DetectorMode::kFull;
};

}  // namespace orbslam
