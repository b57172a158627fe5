// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// Numbers of the published method, and those that it leaves open (marked so).
struct PaperDetectorOptions {
  double max_range_m = 6.0;      // open: beyond it a Kinect's depth noise (6 cm) blurs a person's depth away
  double voxel_m = 0.02;         // open: twice the spacing of a VGA depth image's pixels at 5 m
  int outlier_neighbors = 8;     // open: a point and the ring of voxels round it on a surface
  double outlier_sigmas = 3.0;   // open: of the mean distance to these neighbours, over the cloud
  double cluster_gap_m = 0.05;   // open: parts of one thing are nearer to each other
  int min_cluster_points = 200;  // published
  double tau = 0.25;             // published: dynamic if the line integral exceeds tau * S_p
  double max_speed_mps = 1.5;    // open: a brisk walk
  /// The rows of the histogram are the clusters that were associated frame to frame, instead of everything
  /// inside the swept volume.
  bool associated_rows = false;
};

/// One depth image as a cloud.
struct PaperFrame {
  double timestamp_s = 0;
  std::vector<Eigen::Vector3f> points_m;  // camera frame
  std::vector<int> pixel_indices;         // of the source pixel, one a point
};

/// A cluster that could be judged.
struct PaperObject {
  Eigen::Vector3f centroid_m = Eigen::Vector3f::Zero();    // camera frame
  Eigen::Vector3f velocity_mps = Eigen::Vector3f::Zero();  // camera axes, ego-motion taken off
  double line_integral_ratio = 0;                          // delta / (tau S_p): dynamic above 1
  int num_points = 0;                                      // S_p, voxels
  int num_pixels = 0;                                      // source pixels of the frame
  bool IsDynamic() const { return line_integral_ratio > 1; }
};

struct PaperResult {
  std::vector<int> dynamic_pixels;  // pixel_indices of the points of dynamic clusters, in the frame's order
  std::vector<PaperObject> objects;
};

/// The detector as published ("A dynamic detection method to improve SLAM performance"), with ego-motion
/// compensation: cloud -> voxel grid -> outliers -> Euclidean clusters -> association to the most similar
/// cluster of the previous frame -> motion vectors V, direction W -> histogram H over nine frames -> largest
/// integral along a sloped line -> tau. Keeps the last nine clouds itself; judges nothing until it has them.
/// The window trails: t-8..t.
class PaperDetector {
 public:
  explicit PaperDetector(const PaperDetectorOptions& options);
  ~PaperDetector();
  PaperDetector(PaperDetector&&) noexcept;
  PaperDetector& operator=(PaperDetector&&) noexcept;

  /// Frames in order of time. `current_from_previous`: the depth camera's own motion since the frame before,
  /// the identity for the first.
  PaperResult Process(const PaperFrame& frame, const Rigid3d& current_from_previous);

  /// Forgets the past: for a frame whose motion since the one before is not known.
  void Reset();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace orbslam
