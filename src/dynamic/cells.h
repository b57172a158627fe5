// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <span>

namespace orbslam {

/// All elements of a continuous image, row by row. (An image's own operator()(i) looks at its layout each
/// time.)
template <typename T>
std::span<T> Cells(cv::Mat_<T>& image) {
  return {image[0], image.total()};
}
template <typename T>
std::span<const T> Cells(const cv::Mat_<T>& image) {
  return {image[0], image.total()};
}

/// How many of the 3 x 3 cells around each are non-zero.
cv::Mat1b CountAround(const cv::Mat1b& cells);

}  // namespace orbslam
