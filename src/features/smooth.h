// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace orbslam {

/// Gaussian of 7 x 7 px, sigma 2, borders mirrored: what OpenCV's ORB does before it describes, to the bit.
/// (There cv::GaussianBlur sees a part of a larger image, which makes it filter in single precision; on a
/// whole image it uses 8-bit weights, and every tenth descriptor differs by a bit.) Keeps buffers.
class Smoother {
 public:
  using Weights = std::array<float, 7>;

  Smoother();

  /// image and *out: CV_8UC1, not the same memory. *out is allocated as needed.
  void Smooth(const cv::Mat& image, cv::Mat* out);

 private:
  void SmoothBySimd(const cv::Mat& image, cv::Mat* out);
  void SmoothByOpenCv(const cv::Mat& image, cv::Mat* out);

  Weights weights_;
  std::vector<float> buffer_;
  cv::Mat padded_;
};

}  // namespace orbslam
