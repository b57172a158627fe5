// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "figure_cloth.h"

namespace orbslam {

/// Corrugated cardboard with tape, print and a label.
Picture PaintCarton(Rng* rng);
/// Boards with grain.
Picture PaintWood(Rng* rng);
/// Papers of many sizes with print, pinned one over the other.
Picture PaintNotices(Rng* rng);
/// Backs of files, one beside the other.
Picture PaintFiles(Rng* rng);

}  // namespace orbslam
