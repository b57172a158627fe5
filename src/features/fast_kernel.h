// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace orbslam {

/// The two inner loops of FAST, one version an instruction set. Both work on blocks of at most 32 pixels and
/// may read the pixels, and write the scores, up to the end of the last block.
struct FastKernel {
  /// scores[i], for the n pixels from `pixel` on: the largest threshold at which the segment test for 9 of 16
  /// still calls it a corner, if that is at least `threshold`, and anything below `threshold` otherwise. Rows
  /// are `step` bytes apart; 3 rows and columns on either side are read.
  void (*score_row)(const uint8_t* pixel, ptrdiff_t step, int n, uint8_t threshold, uint8_t* scores);

  /// Positions i in [0, n), written to `peaks`, whose score is at least `threshold` (> 0) and higher than all
  /// eight neighbours'. Reads one score before and after. Returns their number.
  int (*find_peaks)(const uint8_t* above, const uint8_t* scores, const uint8_t* below, int n,
                    uint8_t threshold, uint16_t* peaks);
};

constexpr int kFastBlock = 32;

extern const FastKernel kFastSse2;
extern const FastKernel kFastAvx2;

}  // namespace orbslam
