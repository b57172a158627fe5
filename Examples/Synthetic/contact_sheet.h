// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/synthetic/synthetic_sequence.h"

namespace orbslam {

/// Frames spread over the sequence, side by side: colour with what can move tinted blue and what moves tinted
/// red, and below each its depth (near is bright, black is none).
class ContactSheet {
 public:
  static constexpr int kColumns = 4, kRows = 3, kCellWidth = 320, kCellHeight = 240;

  explicit ContactSheet(int num_frames);

  /// Where a frame belongs; -1: not on the sheet.
  int CellOf(int frame_index) const;
  /// Cells of different frames may be drawn at the same time.
  void Draw(int cell, const SyntheticFrame& frame);
  const cv::Mat& image() const { return image_; }

 private:
  int num_frames_;
  cv::Mat image_;
};

}  // namespace orbslam
