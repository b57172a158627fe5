// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "orbslam/dynamic/motion_histogram.h"
#include "orbslam/geometry/rigid3.h"
#include "working_frame.h"

namespace orbslam {

/// Nearest and farthest depth (m) in the 3 x 3 cells around each; 0, 0: under 6 of the 9 are measured. What
/// lies before the nearest stands in space that was seen empty.
cv::Mat2f MakeEnvelope(const cv::Mat1f& depth_m);

/// Depth everywhere: a hole gets the mean of what is known around it, at the finest scale that knows anything
/// (pull-push; Gortler et al., The Lumigraph, 1996).
cv::Mat1f FillHoles(const cv::Mat1f& depth_m);

/// A frame of the past, and where it was from the present one.
struct ReferenceView {
  std::shared_ptr<const WorkingFrame> frame;
  cv::Mat2f envelope_m;
  cv::Mat1f filled_depth_m;              // what has no depth, a monitor say, still looks like something
  cv::Mat1b moving;                      // cells that were masked then
  Rigid3d reference_from_current;        // of the depth images
  Rigid3d color_reference_from_current;  // of the colour images
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();  // of the camera then, in its frame
  int age_frames = 0;
  int half_votes = 2;  // when it sees through; fewer if a rolling shutter bent it otherwise than the present
  bool is_aligned = true;                       // its own alignment with the present frame succeeded
  int frames_unaligned = 0;                     // in a row, until now
  std::shared_ptr<const HistogramCloud> cloud;  // for the motion histogram; may be null
};

}  // namespace orbslam
