// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "orbslam/dynamic/motion_vectors.h"
#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// The histogram looks at this many consecutive frames: the current one and the eight before it.
inline constexpr int kMotionHistogramRows = 9;

/// The points of one depth image in its own camera frame, ready to be searched: runs of neighbouring points
/// (an image's rows, or a voxel grid's order) with a sphere round each, so that what is far away is passed
/// over sixteen at a time. Made once a frame, used by nine.
class HistogramCloud {
 public:
  HistogramCloud() = default;
  /// Points that are not finite or not before the camera are left out. Without weights a point counts z^2
  /// (m^2): a pixel covers a surface that grows with z^2, so that a surface counts the same at any distance.
  /// Otherwise one weight a point (all 1: points are counted, as in the published method).
  explicit HistogramCloud(std::span<const Eigen::Vector3f> points_m, std::span<const float> weights = {});

  /// Neighbouring points side by side, so that they are tested together. The last block of a cloud is filled
  /// up with points of weight zero.
  struct Block {
    static constexpr int kSize = 16;
    std::array<float, kSize> x_m, y_m, z_m, weight;
  };
  std::span<const Block> blocks() const { return blocks_; }

  /// Round the points of each block, one entry a block: apart from these, so that those passed over stay out
  /// of the cache, and structure of arrays, for vectors.
  struct Spheres {
    std::vector<float> x_m, y_m, z_m, radius_m;
  };
  const Spheres& spheres() const { return spheres_; }

 private:
  std::vector<Block> blocks_;
  Spheres spheres_;
};

/// Sum of z^2 of the points: S_p in the units of an unweighted HistogramCloud.
double SurfaceWeight(std::span<const Eigen::Vector3f> points_m);

/// One row of the histogram: a frame's cloud, and where and when it was taken relative to the current frame.
struct HistogramRow {
  const HistogramCloud* cloud = nullptr;
  Rigid3d current_from_cloud;  // ego-motion of the depth camera; the identity for clouds already in its frame
  double time_s = 0;           // <= 0, zero for the current frame
};

/// The ball swept along the line of motion, as far as max_speed_mps carries it within the rows' time span to
/// either side: a capsule in the current camera frame.
struct SweptVolume {
  MotionBall ball;
  Eigen::Vector3f direction = Eigen::Vector3f::UnitX();  // W, unit length
  float max_speed_mps = 1.5F;  // a brisk walk; faster things leave the ball's picture
};

/// H: the "superimposed clouds", how much stands where along W at each time.
struct MotionHistogram {
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Matrix weights;               // rows: time, oldest first; columns: position along W
  std::vector<double> times_s;  // of the rows, ascending, relative to the current frame
  float bin_m = 0;              // width of a column
  float first_m = 0;            // centre of column 0: position along W relative to the ball's centre
  float max_speed_mps = 0;      // of the volume

  /// Oldest row to newest.
  double DurationS() const { return times_s.empty() ? 0.0 : times_s.back() - times_s.front(); }
};

/// Bins must not be finer than the depth noise there, or a static surface flickers between them: max(2 cm,
/// 2 sigma_z).
float HistogramBinM(float depth_m);

/// Projects the points that lie in the swept volume onto W. The same volume is used in all rows, whatever was
/// segmented in them. A point's weight is split between the two bins whose centres are nearest (so that noise
/// moves it smoothly), and the histogram's total is the weight of the points inside the volume. `rows` ascend
/// in time.
MotionHistogram BuildMotionHistogram(std::span<const HistogramRow> rows, const SweptVolume& volume);

/// Where a cluster lies along W, relative to the ball's centre; metres.
struct ClusterExtent {
  float low_m = 0;
  float high_m = 0;
};
/// Extent of the points inside the volume's ball; zero if there are none.
ClusterExtent ExtentAlong(std::span<const Eigen::Vector3f> points_m, const SweptVolume& volume);

}  // namespace orbslam
