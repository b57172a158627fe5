// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/mask_doubt.h"

namespace orbslam {

void MaskDoubt::Note(const DynamicMask& moving, double timestamp_s) {
  if (moving.MaskedShare() > options_.doubtful_share) last_filled_s_ = timestamp_s;
  const bool cannot_tell = moving.mask.empty() && !moving.fail_open_reason.empty();
  if (cannot_tell && timestamp_s - last_filled_s_ < options_.max_doubt_s)
    ends_s_ = timestamp_s + options_.max_doubt_s;
}

}  // namespace orbslam
