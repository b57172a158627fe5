// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference_view.h"

#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

constexpr float kFar = 1e6f;  // stands for "no depth" where the nearest is sought
constexpr int kMinMeasured = 6;

}  // namespace

DepthEnvelope MakeEnvelope(const cv::Mat1f& depth_m) {
  cv::Mat1b measured;  // 255 or 0
  cv::compare(depth_m, 0, measured, cv::CMP_GT);
  cv::Mat1f or_far = depth_m.clone();
  or_far.setTo(kFar, ~measured);
  DepthEnvelope envelope;
  cv::erode(or_far, envelope.nearest_m, cv::Mat::ones(3, 3, CV_8U));
  cv::dilate(depth_m, envelope.farthest_m, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat1f count;
  cv::boxFilter(measured, count, CV_32F, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::Mat1b thin;
  cv::compare(count, 255.0 * kMinMeasured, thin, cv::CMP_LT);
  envelope.nearest_m.setTo(0, thin);
  envelope.farthest_m.setTo(0, thin);
  return envelope;
}

}  // namespace orbslam
