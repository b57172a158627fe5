// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <span>

namespace orbslam {

/// All elements of a continuous image, row by row. (An image's own operator()(i) looks at its layout each time.)
template <typename T>
std::span<T> Cells(cv::Mat_<T>& image) {
  return {image[0], image.total()};
}
template <typename T>
std::span<const T> Cells(const cv::Mat_<T>& image) {
  return {image[0], image.total()};
}

}  // namespace orbslam
