// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/texture.h"

#include <opencv2/imgproc.hpp>

#include "orbslam/util/check.h"

namespace orbslam {

Texture::Texture(const cv::Mat& image) {
  ORBSLAM_CHECK(image.type() == CV_8UC4);
  ORBSLAM_CHECK(image.cols % kSideMultiple == 0 && image.cols >= 2 * kSideMultiple);
  ORBSLAM_CHECK(image.rows % kSideMultiple == 0 && image.rows >= 2 * kSideMultiple);
  levels_[0] = image.clone();
  for (int level = 1; level < kNumLevels; ++level) {
    cv::resize(levels_[level - 1], levels_[level], {}, 0.5, 0.5, cv::INTER_AREA);
  }
}

}  // namespace orbslam
