// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "orbslam/pipeline/dynamic_mask.h"
#include "working_frame.h"

namespace orbslam {

/// The connected parts of a mask of cells as objects, which keep their ids while they overlap from frame to
/// frame.
class ObjectTracker {
 public:
  struct Labelled {
    std::vector<DynamicObject> objects;
    cv::Mat1i object_of_cell;  // index into objects, -1: none
  };

  /// shift: where each cell was in the last frame (motion_field.h). Centroids are those of the cells with
  /// depth, zero without any; num_pixels counts raw pixels; velocity and line integral are left to others.
  Labelled Update(const GridCamera& camera, int pixels_per_cell, const cv::Mat1b& moving,
                  const WorkingFrame& frame, const cv::Mat1f& log_odds, const cv::Mat2f& shift);
  void Reset() { previous_ids_.release(); }

 private:
  std::vector<int> InheritIds(const cv::Mat1i& parts, int num_parts, const cv::Mat2f& shift);

  cv::Mat1i previous_ids_;  // cells: id of the object there in the last frame, 0: none
  int last_id_ = 0;
};

}  // namespace orbslam
