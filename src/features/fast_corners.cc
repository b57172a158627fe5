// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_corners.h"

#include <algorithm>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

constexpr int kCellPx = 32;
constexpr int kMargin = kFastBlock + 1;  // of a row of scores: the suppression reads beyond both ends

struct Cells {
  explicit Cells(const cv::Rect& area)
      : columns(std::max(1, area.width / kCellPx)),
        rows(std::max(1, area.height / kCellPx)),
        width((area.width + columns - 1) / columns),
        height((area.height + rows - 1) / rows) {}
  int columns, rows, width, height;
};

}  // namespace

FastCorners::FastCorners(int threshold, int min_threshold)
    : threshold_(threshold),
      min_threshold_(min_threshold),
      kernel_(__builtin_cpu_supports("avx2") ? kFastAvx2 : kFastSse2) {
  ORBSLAM_CHECK(1 <= min_threshold && min_threshold <= threshold && threshold <= 255);
}

const std::vector<Corner>& FastCorners::Detect(const cv::Mat& image, int border) {
  ORBSLAM_CHECK(border >= 4);
  corners_.clear();
  const cv::Rect area(border, border, image.cols - 2 * border, image.rows - 2 * border);
  if (area.width <= 0 || area.height <= 0) return corners_;
  ScanRows(image, area);
  KeepStrongOrLonely(area);
  return corners_;
}

void FastCorners::ScanRows(const cv::Mat& image, const cv::Rect& area) {
  const int scored = area.width + 2;  // one more on each side for the suppression
  for (auto& row : scores_) row.assign(scored + 2 * kMargin, 0);
  peaks_.resize(area.width);
  const auto threshold = static_cast<uint8_t>(min_threshold_);
  for (int y = area.y - 1; y <= area.y + area.height; ++y) {
    uint8_t* scores = scores_[y % 3].data() + kMargin;
    kernel_.score_row(image.ptr(y) + area.x - 1, static_cast<ptrdiff_t>(image.step), scored, threshold,
                      scores);
    std::fill_n(scores + scored, kFastBlock, uint8_t{0});
    if (y <= area.y) continue;
    const uint8_t* middle = scores_[(y - 1) % 3].data() + kMargin + 1;
    const int count = kernel_.find_peaks(scores_[(y - 2) % 3].data() + kMargin + 1, middle, scores + 1,
                                         area.width, threshold, peaks_.data());
    for (int i = 0; i < count; ++i) {
      corners_.push_back(
          {static_cast<int16_t>(area.x + peaks_[i]), static_cast<int16_t>(y - 1), middle[peaks_[i]]});
    }
  }
}

void FastCorners::KeepStrongOrLonely(const cv::Rect& area) {
  const Cells cells(area);
  cell_best_.assign(cells.columns * cells.rows, 0);
  auto best_of = [&](const Corner& corner) -> uint8_t& {
    return cell_best_[(corner.y - area.y) / cells.height * cells.columns + (corner.x - area.x) / cells.width];
  };
  for (const Corner& corner : corners_) {
    uint8_t& best = best_of(corner);
    best = std::max(best, static_cast<uint8_t>(corner.score));
  }
  std::erase_if(corners_, [&](const Corner& corner) {
    return corner.score < threshold_ && best_of(corner) >= threshold_;
  });
}

}  // namespace orbslam
