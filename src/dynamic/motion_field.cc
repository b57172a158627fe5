// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion_field.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

constexpr int kBlock = 8;          // cells, side of the blocks in which shifts are averaged
constexpr int kPixelsPerCell = 2;  // grey px

}  // namespace

cv::Mat2f BackwardMotion(cv::Size cells, const std::vector<TrackedCorner>& corners) {
  bool any_moving = false;
  for (const TrackedCorner& corner : corners) any_moving = any_moving || corner.was_moving;

  const cv::Size blocks((cells.width + kBlock - 1) / kBlock, (cells.height + kBlock - 1) / kBlock);
  cv::Mat3f sums(blocks, cv::Vec3f(0, 0, 0));  // weighted shifts, weight
  for (const TrackedCorner& corner : corners) {
    if (any_moving && !corner.was_moving) continue;
    const int u = cvFloor(corner.current.x / (kPixelsPerCell * kBlock));
    const int v = cvFloor(corner.current.y / (kPixelsPerCell * kBlock));
    if (u < 0 || v < 0 || u >= blocks.width || v >= blocks.height) continue;
    const cv::Point2f shift = (corner.previous - corner.current) / static_cast<float>(kPixelsPerCell);
    sums(v, u) += cv::Vec3f(shift.x, shift.y, 1);
  }
  // Normalised convolution (Knutsson and Westin 1993), wide and thin beneath the narrow one: near corners
  // rule.
  cv::Mat3f narrow, wide;
  cv::GaussianBlur(sums, narrow, {5, 5}, 0.8, 0.8, cv::BORDER_CONSTANT);
  cv::GaussianBlur(sums, wide, {31, 31}, 5, 5, cv::BORDER_CONSTANT);
  cv::Mat2f coarse(blocks), shift;
  for (int i = 0; i < static_cast<int>(coarse.total()); ++i) {
    const cv::Vec3f sum = narrow(i) + 0.1f * wide(i);
    coarse(i) = sum[2] > 1e-6f ? cv::Vec2f(sum[0] / sum[2], sum[1] / sum[2]) : cv::Vec2f(0, 0);
  }
  cv::resize(coarse, shift, {blocks.width * kBlock, blocks.height * kBlock}, 0, 0, cv::INTER_LINEAR);
  return shift(cv::Rect({0, 0}, cells)).clone();
}

cv::Mat1f CarryOver(const cv::Mat1f& image, const cv::Mat2f& shift) {
  cv::Mat1f carried(image.size());
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const cv::Vec2f& s = shift(v, u);
      const int x = u + cvRound(s[0]), y = v + cvRound(s[1]);
      const int cx = std::clamp(x, 0, image.cols - 1), cy = std::clamp(y, 0, image.rows - 1);
      carried(v, u) = image(cy, cx) * (cx == x && cy == y ? 1.f : 0.5f);
    }
  return carried;
}

}  // namespace orbslam
