// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "orbslam/util/result.h"

namespace orbslam {

bool IsPng(std::string_view bytes);

/// CV_8UC1 or CV_8UC3 in the file's order, RGB. Palettes are expanded, transparency is dropped.
Result<cv::Mat> DecodePngColor(std::string_view bytes);

/// CV_16UC1.
Result<cv::Mat> DecodePngDepth(std::string_view bytes);

/// image: CV_8UC1, CV_8UC3 (RGB) or CV_16UC1, continuous. compression_level: 0-9; 1 is for many pictures a
/// second.
Result<std::string> EncodePng(const cv::Mat& image, int compression_level);

}  // namespace orbslam
