// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "orbslam/pipeline/dynamic_mask.h"
#include "orbslam/tracking/tracking_options.h"

namespace orbslam {

/// Whether moving things may look static: where they filled the picture a moment ago, and nobody can tell now
/// what moves, they still may for a while. No keyframes then.
class MaskDoubt {
 public:
  explicit MaskDoubt(const TrackingOptions& options) : options_(options) {}

  /// The next frame's mask.
  void Note(const DynamicMask& moving, double timestamp_s);
  bool Holds(double timestamp_s) const { return timestamp_s <= ends_s_; }

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  TrackingOptions options_;
  double last_filled_s_ = kNever;  // when moving things last filled the picture
  double ends_s_ = kNever;
};

}  // namespace orbslam
