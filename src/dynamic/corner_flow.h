// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "orbslam/dynamic/dynamic_detector_options.h"

namespace orbslam {

/// Corners (FAST-9, Rosten and Drummond 2006) of a grey image, spread over it.
std::vector<cv::Point2f> SpreadCorners(const cv::Mat1b& gray, const CornerOptions& options);

struct FlowResult {
  cv::Point2f position;
  bool ok = false;
};

/// A patch to be found again.
struct FlowQuery {
  cv::Point2f position;   // in the first image
  cv::Point2f predicted;  // in the second
  /// Offsets within the patch in the second image -> in the first: how it turned and grew; empty: it did not.
  std::optional<cv::Matx22f> first_from_second;
};

/// Where patches of one pyramid are in another: iterative Lucas-Kanade from coarse to fine on patches of 12 x
/// 12 px (Bouguet 2001), started from predicted. Pyramids: CV_32F, each level half of the last.
std::vector<FlowResult> TrackPatches(const std::vector<cv::Mat1f>& first,
                                     const std::vector<cv::Mat1f>& second, std::span<const FlowQuery> queries,
                                     const FlowOptions& options);

}  // namespace orbslam
