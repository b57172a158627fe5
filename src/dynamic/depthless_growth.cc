// SPDX-License-Identifier: GPL-3.0-or-later
#include "depthless_growth.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace orbslam {
namespace {

/// Mean over 5 x 5 of the cells without depth.
cv::Mat1f Smoothed(const cv::Mat1f& log_odds, const cv::Mat1f& weight) {
  cv::Mat1f sum, count;
  cv::boxFilter(log_odds, sum, CV_32F, {5, 5}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(weight, count, CV_32F, {5, 5}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::Mat1f mean;
  cv::divide(sum, count, mean);
  mean.setTo(0, weight == 0);
  return mean;
}

/// What the corners say, spread over the blocks around them; log-odds a cell.
cv::Mat1f CornerLogOdds(cv::Size cells, const std::vector<TrackedCorner>& corners,
                        const GrowthOptions& options) {
  constexpr float kRestsPx = 1.5f,
                  kMovesPx = 3.f;  // grey px, 1.5 and 3 sigma of flow and of the camera's motion
  constexpr int kBlock = 4;        // cells
  cv::Mat1f blocks(cells.height / kBlock + 1, cells.width / kBlock + 1, 0.f);
  for (const TrackedCorner& corner : corners) {
    const int u = cvFloor(corner.current.x / (2 * kBlock)), v = cvFloor(corner.current.y / (2 * kBlock));
    if (u < 0 || v < 0 || u >= blocks.cols || v >= blocks.rows) continue;
    if (corner.residual_px > kMovesPx) blocks(v, u) += options.corner_moves;
    if (corner.residual_px < kRestsPx) blocks(v, u) += options.corner_rests;
  }
  cv::Mat1f spread, log_odds;
  cv::boxFilter(blocks, spread, CV_32F, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::resize(spread, log_odds, {blocks.cols * kBlock, blocks.rows * kBlock}, 0, 0, cv::INTER_LINEAR);
  return log_odds(cv::Rect({0, 0}, cells));
}

}  // namespace

cv::Mat1f DepthlessLogOdds(const WorkingFrame& frame, const cv::Mat1f& carried,
                           const BackgroundView& background, const std::vector<TrackedCorner>& corners,
                           const GrowthOptions& options) {
  const cv::Mat1f& gray = frame.pyramid[1];
  const cv::Mat1f from_corners = CornerLogOdds(gray.size(), corners, options);
  cv::Mat1f log_odds(gray.size(), 0.f), weight(gray.size(), 0.f);
  for (int v = 0; v < gray.rows; ++v)
    for (int u = 0; u < gray.cols; ++u) {
      if (frame.depth_m(v, u) > 0) continue;
      weight(v, u) = 1;
      float value = options.memory * carried(v, u) + options.prior;
      float flow = options.use_corners ? std::clamp(from_corners(v, u), -1.f, 1.f) : 0.f;
      const bool is_known = options.use_background && background.depth_m(v, u) > 0;
      const bool agrees = is_known && gray(v, u) > background.darkest(v, u) - options.noise_gray &&
                          gray(v, u) < background.brightest(v, u) + options.noise_gray;
      if (is_known) value += agrees ? options.agrees : options.differs;
      // Corners of who comes straight on, or pauses, rest at some depth: what rests must look as before, too.
      if (options.use_background && !agrees) flow = std::max(flow, 0.f);
      value += flow;
      log_odds(v, u) = value;
    }
  return Smoothed(log_odds, weight);
}

cv::Mat1b GrowIntoDepthless(const cv::Mat1b& moving, const WorkingFrame& frame, const cv::Mat1f& log_odds,
                            const cv::Mat1f& carried, const GrowthOptions& options) {
  const cv::Mat1f& gray = frame.pyramid[1];
  cv::Mat1b grown = moving.clone();
  std::vector<cv::Point> front, next;
  for (int v = 0; v < grown.rows; ++v)
    for (int u = 0; u < grown.cols; ++u) {
      const bool persists = frame.depth_m(v, u) == 0 && carried(v, u) > 0 && log_odds(v, u) > 0;
      if (persists) grown(v, u) = 255;
      if (grown(v, u) != 0) front.emplace_back(u, v);
    }
  const cv::Rect inside(0, 0, grown.cols, grown.rows);
  for (int step = 0; step < options.max_steps && !front.empty(); ++step) {
    next.clear();
    for (const cv::Point& cell : front)
      for (const cv::Point& offset : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point neighbor = cell + offset;
        if (!inside.contains(neighbor) || grown(neighbor) != 0 || frame.depth_m(neighbor) > 0) continue;
        const bool similar = std::abs(gray(neighbor) - gray(cell)) < options.similar_gray;
        const float contact = step < options.free_steps ? options.contact
                              : similar                 ? options.similar_contact
                                                        : options.other_contact;
        if (log_odds(neighbor) + contact <= 0) continue;
        grown(neighbor) = 255;
        next.push_back(neighbor);
      }
    std::swap(front, next);
  }
  return grown;
}

}  // namespace orbslam
