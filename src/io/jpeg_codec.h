// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <string_view>

#include "orbslam/util/result.h"

namespace orbslam {

enum class JpegPixels { kGray, kBgr, kAsStored };

bool IsJpeg(std::string_view bytes);

/// CV_8UC1 (luma only, which skips most of the work) or CV_8UC3 (BGR).
Result<cv::Mat> DecodeJpeg(std::string_view bytes, JpegPixels pixels);

}  // namespace orbslam
