// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "background_view.h"
#include "camera_motion.h"

namespace orbslam {

struct GrowthOptions {
  bool use_background = true;        // appearance against the expected static scene
  bool use_corners = true;           // flow against the camera's motion
  int max_steps = 12;                // cells: how far from a moving cell that has depth ...
  int free_steps = 3;                // ... silhouettes that the sensor loses
  float similar_gray = 15.f;         // grey levels between neighbours of one thing
  float noise_gray = 12.f;           // grey levels: 3 sigma of camera noise, and of what the reduction leaves
  // Log-odds, a frame:
  float prior = -0.15f;              // without evidence
  float differs = 0.6f;              // looks other than the static scene expected there
  float agrees = -0.6f;              // looks like it
  float corner_moves = 0.8f;         // a corner in the block does not move as the static scene,
  float corner_rests = -0.5f;        // does
  float contact = 0.5f;              // connected to a moving cell that has depth
  float memory = 0.9f;               // share of the last frame's that is kept: a third of a second
  // Log-odds of a cell when the mask has grown up to it:
  float near_contact = 1.f;          // within free_steps of a moving cell,
  float similar_contact = 0.3f;      // beyond it, of similar grey
  float other_contact = -1.5f;       // beyond it, not of similar grey
};

/// Log-odds of cells without depth, carried over and with this frame's evidence; 0 where there is depth.
cv::Mat1f DepthlessLogOdds(const WorkingFrame& frame, const cv::Mat1f& carried, const BackgroundView& background,
                           const std::vector<TrackedCorner>& corners, const GrowthOptions& options);

/// Grows the moving cells (non-zero), and those without depth that were moving before, into neighbours without
/// depth while the odds are for it. Returns the grown mask.
cv::Mat1b GrowIntoDepthless(const cv::Mat1b& moving, const WorkingFrame& frame, const cv::Mat1f& log_odds,
                            const cv::Mat1f& carried, const GrowthOptions& options);

}  // namespace orbslam
