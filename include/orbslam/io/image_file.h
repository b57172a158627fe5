// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "orbslam/util/result.h"

namespace orbslam {

// PNG (libspng) and JPEG (libturbojpeg) files, told apart by their first bytes and not by their names.
// OpenCV's imgcodecs is not linked: Debian's loads GDAL and with it 140 shared libraries into every start.
// All errors are one line that begins with the path: missing, a directory, empty, neither PNG nor JPEG,
// truncated, corrupt, wider or higher than 16384 px, or not of the expected kind (then with what was found).

/// CV_8UC1. A colour PNG is weighted 0.299 R + 0.587 G + 0.114 B as cv::cvtColor does; a JPEG gives its luma,
/// which is the same up to rounding and twice as fast.
Result<cv::Mat> ReadGray(const std::string& path);

/// CV_8UC1 or CV_8UC3 (BGR), as stored. Palettes are expanded, transparency is dropped, 16-bit colour is
/// refused.
Result<cv::Mat> ReadColorOrGray(const std::string& path);

struct GrayAndBgr {
  cv::Mat gray;  // CV_8UC1, exactly ReadGray()'s
  cv::Mat bgr;   // CV_8UC3; of a gray image, three equal channels
};
Result<GrayAndBgr> ReadGrayAndBgr(const std::string& path);

/// CV_16UC1 in the file's units. Only a 16-bit one-channel PNG is a depth image.
Result<cv::Mat> ReadDepth(const std::string& path);

/// image: CV_8UC1, CV_8UC3 (BGR) or CV_16UC1, not empty. compression_level: zlib's, 0 (fastest) to 9
/// (smallest). Written as WriteFileAtomically() does, with its errors.
Status WritePng(const std::string& path, const cv::Mat& image, int compression_level = 6);

}  // namespace orbslam
