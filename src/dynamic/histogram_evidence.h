// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "camera_motion.h"
#include "orbslam/dynamic/line_integral.h"
#include "scene_history.h"
#include "segmenter.h"

namespace orbslam {

/// Every stride-th cell of a frame as a cloud for the motion histogram.
std::shared_ptr<const HistogramCloud> MakeHistogramCloud(const GridCamera& camera, const cv::Mat1f& depth_m,
                                                         int stride);

/// The clouds of the last nine frames in the present frame: what the motion histogram of any cluster is made
/// of.
class HistogramWindow {
 public:
  HistogramWindow(const GridCamera& camera, const SceneHistory& history, const WorkingFrame& current,
                  const HistogramOptions& options);

  /// Fewer frames than the histogram has rows: nothing can be said yet.
  bool IsFull() const { return rows_.size() == kMotionHistogramRows; }
  /// How a cluster moves. Directions tried: that of its corners, if it has some, and the camera's x and z
  /// axes.
  ClusterMotion Motion(const Cluster& cluster, std::span<const TrackedCorner> corners) const;
  std::shared_ptr<const HistogramCloud> current_cloud() const { return current_cloud_; }

 private:
  GridCamera camera_;
  HistogramOptions options_;
  const cv::Mat1f& depth_m_;
  std::shared_ptr<const HistogramCloud> current_cloud_;
  std::vector<HistogramRow> rows_;
};

}  // namespace orbslam
