// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/fast_corners.h"

#include <algorithm>
#include <array>

#include "cpu.h"
#include "fast_kernel.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

constexpr int kCellPx = 32;
// Of this, 4 px are the circle and the suppression; the others keep what is read behind the last block in the
// image.
constexpr int kMinBorder = 8;

// Length of a cell, so that cells of about kCellPx fill the whole length.
int CellLength(int length) {
  const int cells = std::max(1, length / kCellPx);
  return (length + cells - 1) / cells;
}

}  // namespace

FastCorners::FastCorners(int threshold, int min_threshold)
    : threshold_(threshold), min_threshold_(min_threshold), kernel_(HasAvx2AndFma() ? kFastAvx2 : kFastSse2) {
  ORBSLAM_CHECK(1 <= min_threshold && min_threshold <= threshold && threshold <= 255);
}

const std::vector<Corner>& FastCorners::Detect(const cv::Mat& image, int border) {
  ORBSLAM_CHECK(border >= kMinBorder);
  corners_.clear();
  const cv::Rect area(border, border, image.cols - 2 * border, image.rows - 2 * border);
  if (area.width <= 0 || area.height <= 0) return corners_;
  const int cell_width = CellLength(area.width), cell_height = CellLength(area.height);
  const int scored = area.width + 2;
  // Blocks of scores end, and suppression reads, up to kFastBlock behind a row.
  const int stride = scored + 2 * kFastBlock;
  scores_.assign((cell_height + 2) * stride + 1, 0);
  peaks_.resize(area.width);
  for (int top = area.y; top < area.br().y; top += cell_height) {
    const int height = std::min(cell_height, area.br().y - top);
    for (int row = 0; row < height + 2; ++row) {
      uint8_t* scores = scores_.data() + row * stride;
      kernel_.score_row(image.ptr(top - 1 + row) + area.x - 1, static_cast<ptrdiff_t>(image.step), scored,
                        static_cast<uint8_t>(min_threshold_), scores);
    }
    const Band band{{area.x, top, area.width, height}, stride, scores_.data() + stride + 1};
    const size_t first = corners_.size();
    FindCorners(band, 0, area.width, threshold_);
    if (min_threshold_ < threshold_) FindLonelyCorners(band, cell_width, first);
  }
  return corners_;
}

cv::Point2f FastCorners::PeakOffset(const cv::Mat& image, const Corner& corner) const {
  constexpr float kMaxPx = 0.49f;  // farther, another pixel would be the corner
  std::array<std::array<uint8_t, kFastBlock>, 3> s;
  for (int row = 0; row < 3; ++row) {
    kernel_.score_row(image.ptr(corner.y - 1 + row) + corner.x - 1, static_cast<ptrdiff_t>(image.step), 3,
                      /*threshold=*/1, s[row].data());
  }
  // Least squares over the nine scores: gradient and second derivatives in the middle.
  float gx = 0, gy = 0, xx = 0, yy = 0;
  for (int i = 0; i < 3; ++i) {
    gx += static_cast<float>(s[i][2] - s[i][0]) / 6;
    gy += static_cast<float>(s[2][i] - s[0][i]) / 6;
    xx += static_cast<float>(s[i][0] - 2 * s[i][1] + s[i][2]) / 3;
    yy += static_cast<float>(s[0][i] - 2 * s[1][i] + s[2][i]) / 3;
  }
  const float xy = static_cast<float>(s[0][0] - s[0][2] - s[2][0] + s[2][2]) / 4;
  const float determinant = xx * yy - xy * xy;
  if (!(xx < 0 && determinant > 0)) return {0, 0};
  return {std::clamp((xy * gy - yy * gx) / determinant, -kMaxPx, kMaxPx),
          std::clamp((xy * gx - xx * gy) / determinant, -kMaxPx, kMaxPx)};
}

void FastCorners::FindCorners(const Band& band, int begin_column, int end_column, int threshold) {
  for (int row = 0; row < band.area.height; ++row) {
    const uint8_t* scores = band.scores + row * band.stride + begin_column;
    const int count =
        kernel_.find_peaks(scores - band.stride, scores, scores + band.stride, end_column - begin_column,
                           static_cast<uint8_t>(threshold), peaks_.data());
    for (int i = 0; i < count; ++i) {
      corners_.push_back({static_cast<int16_t>(band.area.x + begin_column + peaks_[i]),
                          static_cast<int16_t>(band.area.y + row), scores[peaks_[i]]});
    }
  }
}

// Runs of neighbouring cells without a strong corner are searched as one.
void FastCorners::FindLonelyCorners(const Band& band, int cell_width, size_t first_strong) {
  const int width = band.area.width;
  const int cells = (width + cell_width - 1) / cell_width;
  has_strong_.assign(cells + 1, 0);
  has_strong_[cells] = 1;
  for (size_t i = first_strong; i < corners_.size(); ++i) {
    has_strong_[(corners_[i].x - band.area.x) / cell_width] = 1;
  }
  for (int begin = 0; begin < cells; ++begin) {
    if (has_strong_[begin] != 0) continue;
    int end = begin;
    while (has_strong_[end] == 0) ++end;
    FindCorners(band, begin * cell_width, std::min(width, end * cell_width), min_threshold_);
    begin = end;
  }
}

}  // namespace orbslam
