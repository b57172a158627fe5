// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_sheet.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

void Tint(const cv::Mat& mask, const cv::Scalar& bgr, cv::Mat* image) {
  constexpr double kShare = 0.3;
  const cv::Mat tinted = *image * (1 - kShare) + bgr * kShare;
  tinted.copyTo(*image, mask);
}

cv::Mat DepthPicture(const cv::Mat& depth_m) {
  constexpr double kFarM = 6;
  cv::Mat gray, bgr;
  depth_m.convertTo(gray, CV_8U, -230 / kFarM, 245);
  gray.setTo(0, depth_m <= 0);
  cv::cvtColor(gray, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

}  // namespace

ContactSheet::ContactSheet(int num_frames)
    : num_frames_(num_frames),
      image_(2 * kRows * kCellHeight, kColumns * kCellWidth, CV_8UC3, cv::Scalar::all(0)) {}

int ContactSheet::CellOf(int frame_index) const {
  const int cells = std::min(kColumns * kRows, num_frames_);
  const auto frame_of = [&](int cell) { return cells > 1 ? cell * (num_frames_ - 1) / (cells - 1) : 0; };
  for (int cell = 0; cell < cells; ++cell) {
    if (frame_of(cell) == frame_index) return cell;
  }
  return -1;
}

void ContactSheet::Draw(int cell, const SyntheticFrame& frame) {
  cv::Mat color = frame.bgr.clone();
  Tint(frame.mask, {255, 120, 0}, &color);
  Tint(frame.mask_moving, {0, 0, 255}, &color);
  const int x = cell % kColumns * kCellWidth, y = cell / kColumns * 2 * kCellHeight;
  cv::Mat upper = image_(cv::Rect(x, y, kCellWidth, kCellHeight));
  cv::Mat lower = image_(cv::Rect(x, y + kCellHeight, kCellWidth, kCellHeight));
  cv::resize(color, upper, upper.size(), 0, 0, cv::INTER_AREA);
  cv::resize(DepthPicture(frame.depth_m), lower, lower.size(), 0, 0, cv::INTER_NEAREST);
}

}  // namespace orbslam
