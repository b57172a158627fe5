// SPDX-License-Identifier: GPL-3.0-or-later
#include "depthless_growth.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "cells.h"

namespace orbslam {
namespace {

constexpr int kReach = 2;  // cells

/// Mean over 5 x 5 of the cells without depth, at these. Both are framed by kReach cells of zeros. (Mostly
/// few: cv::boxFilter takes four times as long.)
cv::Mat1f MeansOfDepthless(const cv::Mat1f& log_odds, const cv::Mat1b& is_depthless) {
  cv::Mat1f means(log_odds.rows - 2 * kReach, log_odds.cols - 2 * kReach, 0.f);
  for (int v = 0; v < means.rows; ++v) {
    const uint8_t* is_wanted = is_depthless[v + kReach] + kReach;
    for (int u = 0; u < means.cols; ++u) {
      if (is_wanted[u] == 0) continue;
      double sum = 0;
      int count = 0;
      for (int y = v; y <= v + 2 * kReach; ++y)
        for (int x = u; x <= u + 2 * kReach; ++x) sum += log_odds[y][x], count += is_depthless[y][x];
      means[v][u] = static_cast<float>(sum) / static_cast<float>(count);
    }
  }
  return means;
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
  const cv::Size framed(gray.cols + 2 * kReach, gray.rows + 2 * kReach);
  cv::Mat1f log_odds(framed, 0.f);
  cv::Mat1b is_depthless(framed, uint8_t{0});
  for (int v = 0; v < gray.rows; ++v)
    for (int u = 0; u < gray.cols; ++u) {
      if (frame.depth_m(v, u) > 0) continue;
      is_depthless(v + kReach, u + kReach) = 1;
      float value = options.memory * carried(v, u) + options.prior;
      float flow = options.use_corners ? std::clamp(from_corners(v, u), -1.f, 1.f) : 0.f;
      const bool is_known = options.use_background && background.depth_m(v, u) > 0;
      const bool agrees = is_known && gray(v, u) > background.darkest(v, u) - options.noise_gray &&
                          gray(v, u) < background.brightest(v, u) + options.noise_gray;
      if (is_known) value += agrees ? options.agrees : options.differs;
      // Corners of who comes straight on, or pauses, rest at some depth: what rests must look as before, too.
      if (options.use_background && !agrees) flow = std::max(flow, 0.f);
      value += flow;
      log_odds(v + kReach, u + kReach) = value;
    }
  return MeansOfDepthless(log_odds, is_depthless);
}

cv::Mat1b GrowIntoDepthless(const cv::Mat1b& moving, const WorkingFrame& frame, const cv::Mat1f& log_odds,
                            const cv::Mat1f& carried, const GrowthOptions& options) {
  const auto gray = Cells(frame.pyramid[1]), depth_m = Cells(frame.depth_m), odds = Cells(log_odds),
             carried_odds = Cells(carried);
  cv::Mat1b grown = moving.clone();
  const auto is_grown = Cells(grown);
  // Framed: where it cannot grow, or has already.
  const int width = grown.cols, framed_width = width + 2;
  cv::Mat1b closed(grown.rows + 2, framed_width, uint8_t{1});
  const auto is_closed = Cells(closed);
  struct Place {
    int cell, framed;
  };
  std::vector<Place> front, next;
  for (int v = 0; v < grown.rows; ++v)
    for (int u = 0; u < width; ++u) {
      const Place here{v * width + u, (v + 1) * framed_width + u + 1};
      const bool is_depthless = depth_m[here.cell] == 0;
      if (is_depthless && carried_odds[here.cell] > 0 && odds[here.cell] > 0) is_grown[here.cell] = 255;
      if (is_grown[here.cell] != 0) front.push_back(here);
      is_closed[here.framed] = is_grown[here.cell] != 0 || depth_m[here.cell] > 0;
    }
  for (int step = 0; step < options.max_steps && !front.empty(); ++step) {
    next.clear();
    for (const auto& [cell, framed] : front)
      for (const Place& to :
           {Place{cell + 1, framed + 1}, Place{cell - 1, framed - 1},
            Place{cell + width, framed + framed_width}, Place{cell - width, framed - framed_width}}) {
        if (is_closed[to.framed] != 0) continue;
        const bool similar = std::abs(gray[to.cell] - gray[cell]) < options.similar_gray;
        const float contact = step < options.free_steps ? options.contact
                              : similar                 ? options.similar_contact
                                                        : options.other_contact;
        if (odds[to.cell] + contact <= 0) continue;
        is_grown[to.cell] = 255, is_closed[to.framed] = 1;
        next.push_back(to);
      }
    std::swap(front, next);
  }
  return grown;
}

}  // namespace orbslam
