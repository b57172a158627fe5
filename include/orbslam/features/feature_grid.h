// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "orbslam/camera/pinhole_camera.h"

namespace orbslam {

/// Keypoints sorted into 64 x 48 cells over the undistorted image, for "which are near (u, v)?".
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(std::span<const cv::Point2f> pixels, const ImageBounds& bounds);

  /// Fills `out` (cleared first) with the indices of keypoints whose |du| and |dv| are below radius_px and whose level
  /// lies in [min_level, max_level]; in cell order, which is deterministic.
  void Near(float u, float v, float radius_px, std::span<const cv::Point2f> pixels, std::span<const int> levels,
            int min_level, int max_level, std::vector<int>* out) const;

  const ImageBounds& bounds() const { return bounds_; }

 private:
  static constexpr int kColumns = 64, kRows = 48;
  int Column(float u) const;  // may lie outside the grid
  int Row(float v) const;

  ImageBounds bounds_;
  std::vector<int> cell_start_;  // kColumns * kRows + 1 offsets into items_
  std::vector<int> items_;
};

}  // namespace orbslam
