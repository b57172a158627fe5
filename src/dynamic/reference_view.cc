// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference_view.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "cells.h"

namespace orbslam {
namespace {

constexpr float kFar = 1e6f;  // stands for "no depth" where the nearest is sought
constexpr int kMinMeasured = 6;

}  // namespace

cv::Mat2f MakeEnvelope(const cv::Mat1f& depth_m) {
  cv::Mat1b measured;  // 255 or 0
  cv::compare(depth_m, 0, measured, cv::CMP_GT);
  cv::Mat1f or_far = depth_m.clone();
  or_far.setTo(kFar, ~measured);
  std::array<cv::Mat, 2> nearest_and_farthest_m;
  cv::erode(or_far, nearest_and_farthest_m[0], cv::Mat::ones(3, 3, CV_8U));
  cv::dilate(depth_m, nearest_and_farthest_m[1], cv::Mat::ones(3, 3, CV_8U));
  cv::Mat2f envelope;
  cv::merge(nearest_and_farthest_m, envelope);
  envelope.setTo(cv::Scalar::all(0), CountAround(measured) < kMinMeasured);
  return envelope;
}

cv::Mat1f FillHoles(const cv::Mat1f& depth_m) {
  std::vector<cv::Mat1f> sums{depth_m}, weights(1);
  cv::Mat(depth_m > 0).convertTo(weights[0], CV_32F, 1 / 255.0);
  while (sums.back().total() > 1) {
    const cv::Size half(std::max(1, sums.back().cols / 2), std::max(1, sums.back().rows / 2));
    cv::Mat1f sum, weight;
    cv::resize(sums.back(), sum, half, 0, 0, cv::INTER_AREA);
    cv::resize(weights.back(), weight, half, 0, 0, cv::INTER_AREA);
    sums.push_back(sum), weights.push_back(weight);
  }
  cv::Mat1f filled(1, 1, 0.f);
  for (size_t level = sums.size(); level-- > 0;) {
    cv::Mat1f finer, mean;
    cv::resize(filled, finer, sums[level].size(), 0, 0, cv::INTER_LINEAR);
    cv::divide(sums[level], weights[level], mean);
    mean.copyTo(finer, weights[level] > 0);
    filled = finer;
  }
  return filled;
}

}  // namespace orbslam
