// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace orbslam {

struct FastKernel;  // the inner loops for one instruction set

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

  /// Corners at least `border` (>= 8) px away from the border of image (CV_8UC1), in an order that depends on
  /// nothing but the image. Valid until the next call.
  const std::vector<Corner>& Detect(const cv::Mat& image, int border);

  /// From a corner's pixel to where its score is highest, at most half a pixel away: the peak of the quadric
  /// that fits the 3 x 3 scores best (Haralick, IJCV 1987, the facet model).
  cv::Point2f PeakOffset(const cv::Mat& image, const Corner& corner) const;

 private:
  // Scores of the rows of one band of cells, and of one row and column more on each side.
  struct Band {
    cv::Rect area;  // px in the image, without the extra rows and columns
    int stride = 0;
    const uint8_t* scores = nullptr;  // of the area's first pixel
  };

  void FindCorners(const Band& band, int begin_column, int end_column, int threshold);
  void FindLonelyCorners(const Band& band, int cell_width, size_t first_strong);

  int threshold_, min_threshold_;
  const FastKernel& kernel_;
  std::vector<uint8_t> scores_;
  std::vector<uint16_t> peaks_;
  std::vector<uint8_t> has_strong_;  // a cell of the band
  std::vector<Corner> corners_;
};

}  // namespace orbslam
