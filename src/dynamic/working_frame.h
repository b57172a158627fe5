// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "orbslam/pipeline/messages.h"

namespace orbslam {

/// The pinhole, free of distortion, of a reduced image.
struct GridCamera {
  int width = 0, height = 0;
  float fx = 0, fy = 0, cx = 0, cy = 0;  // of the reduced pixels

  bool Contains(float u, float v) const {
    return u >= 0 && v >= 0 && u <= static_cast<float>(width - 1) && v <= static_cast<float>(height - 1);
  }
};

/// The cameras of the two grids in which the detector works: grey about 320 wide, depth cells twice as
/// coarse.
struct WorkingGrids {
  int gray_step = 1, cell_step = 2;  // raw px to a grey pixel, to a cell
  GridCamera gray, cell;

  explicit WorkingGrids(const PinholeCamera& camera);
};

/// A frame as the detector sees it: undistorted and reduced. Cell (i, j) covers grey pixels 2i..2i+1,
/// 2j..2j+1.
struct WorkingFrame {
  double timestamp_s = 0;
  cv::Mat1b gray;                          // grey grid
  std::vector<cv::Mat1f> pyramid;          // gray and two halvings of it; grey levels
  std::vector<cv::Point2f> corners;        // of gray, to be followed into later frames
  cv::Mat1f depth_m;                       // cells; 0: none
  cv::Mat1f normal_x, normal_y, normal_z;  // cells; unit, towards the camera; all 0: none
  int num_depth_cells = 0;
};

/// Raw images -> working frames, and cell masks -> raw masks, through look-up tables made once.
class FrameReducer {
 public:
  explicit FrameReducer(const PinholeCamera& camera, const CornerOptions& corners = {});

  const WorkingGrids& grids() const { return grids_; }
  WorkingFrame Reduce(const RgbdImage& image) const;
  /// CV_8UC1, 0 or 255, of the raw image's size.
  cv::Mat1b ToRawMask(const cv::Mat1b& cell_mask) const;

 private:
  cv::Mat1f ReduceDepth(const cv::Mat1f& raw) const;

  WorkingGrids grids_;
  CornerOptions corners_;
  cv::Mat gray_map_, gray_map_fraction_;  // for cv::remap, of the undistorted grey grid into the halved image
  cv::Mat_<cv::Point> cell_corner_;       // raw pixel at a cell's top left; x = -1: outside
  cv::Mat1i raw_to_cell_;                 // cell index of each raw pixel; nearest one where there is none
  cv::Mat1i four_to_cell_;                // the same of each four in a row; -1: they differ
  std::vector<bool> is_like_above_;       // a row of that; free of distortion, most are
};

/// Largest step in depth, metres, between neighbouring cells of one surface: 3 sigma of the sensor's noise
/// at both ends, and a surface seen at 75 degrees.
constexpr float kSurfaceStepM = 0.02f, kSurfaceStepPerM = 0.012f;  // of depth squared
inline float MaxSurfaceStepM(float depth_m) { return kSurfaceStepM + kSurfaceStepPerM * depth_m * depth_m; }

}  // namespace orbslam
