// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "orbslam/dynamic/motion_histogram.h"
#include "orbslam/geometry/rigid3.h"
#include "paper_cloud.h"

namespace orbslam {

/// A cluster of one frame, as the next frames look for it.
struct PaperCluster {
  std::vector<Eigen::Vector3f> points_m;  // its own frame's camera
  Eigen::Vector3f centroid_m;
  int predecessor = -1;  // index of the most similar cluster of the frame before; -1: none
};

/// A frame of the past.
struct PaperView {
  double timestamp_s = 0;
  Rigid3d current_from_view;
  HistogramCloud cloud;  // cleaned; each point counts 1
  std::vector<PaperCluster> clusters;
};

/// The last nine frames, oldest first, their motion relative to the newest, and their clusters' ancestry.
class PaperHistory {
 public:
  void Add(double timestamp_s, const PaperClusters& clusters, const Rigid3d& current_from_previous);
  void Clear() { views_.clear(); }

  bool IsFull() const { return views_.size() == kMotionHistogramRows; }
  const PaperView& current() const { return views_.back(); }

  /// Points of a cluster of the newest frame in the frame before, in the newest frame's camera; empty: none.
  std::vector<Eigen::Vector3f> PredecessorPoints(int cluster) const;
  /// Everything that was seen in each frame.
  std::vector<HistogramRow> WholeRows() const;
  /// Only the cluster's ancestors; `storage` holds their clouds. Frames before the first ancestor are empty.
  std::vector<HistogramRow> AncestorRows(int cluster, std::vector<HistogramCloud>* storage) const;

 private:
  double AgeS(const PaperView& view) const { return view.timestamp_s - views_.back().timestamp_s; }

  std::deque<PaperView> views_;
};

}  // namespace orbslam
