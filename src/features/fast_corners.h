// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "fast_kernel.h"

namespace orbslam {

struct Corner {
  int16_t x = 0, y = 0;  // px
  int score = 0;         // the largest FAST threshold at which it is a corner
};

/// FAST-9-16 (Rosten and Drummond, ECCV 2006) with non-maximum suppression over 3 x 3 pixels. In every cell
/// of about 32 px, corners of at least `threshold` or, where there is none, of at least `min_threshold`.
/// Keeps buffers.
class FastCorners {
 public:
  /// 1 <= min_threshold <= threshold <= 255.
  FastCorners(int threshold, int min_threshold);

  /// Corners at least `border` (>= 4) px away from the border of image (CV_8UC1), ordered by row, then
  /// column.
  const std::vector<Corner>& Detect(const cv::Mat& image, int border);

 private:
  void ScanRows(const cv::Mat& image, const cv::Rect& area);
  void KeepStrongOrLonely(const cv::Rect& area);

  int threshold_, min_threshold_;
  const FastKernel& kernel_;
  std::vector<uint8_t> scores_[3];  // of three rows, with a margin of kMargin before and after
  std::vector<uint16_t> peaks_;
  std::vector<uint8_t> cell_best_;
  std::vector<Corner> corners_;
};

}  // namespace orbslam
