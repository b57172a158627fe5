// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>

#include "orbslam/dynamic/motion_histogram.h"

namespace orbslam {

/// What the best line through a motion histogram says.
struct LineIntegral {
  double integral = 0;      // delta: weight along the line, in the histogram's units
  double ratio = 0;         // delta / S_p; compare with tau
  double velocity_mps = 0;  // the line's slope: speed along +W
};

/// tau of the published method: dynamic if delta > 0.25 S_p.
inline constexpr double kPublishedTau = 0.25;
/// tau of the persistent integral: between the medians of moving (0.10) and of static (0.01) clusters of
/// recorded sequences.
inline constexpr double kPersistentTau = 0.04;

/// The published line integral: a static thing gives the same row nine times, a line without slope, a moving
/// one a sloped line. The largest sum, over the rows, of the bins under a straight line, over all lines whose
/// slope is at most the volume's maximum speed and which leave their first bin by at least one bin within the
/// window (a line that stays inside one bin cannot be told from one without slope). Rows that a line leaves
/// count 0. `cluster_weight`: S_p in the histogram's units, > 0. Zero if the histogram has under two rows.
LineIntegral PublishedLineIntegral(const MotionHistogram& histogram, double cluster_weight);

/// The persistent line integral: how much better motion explains the rows than rest. Raw sums exceed .25 S_p
/// for nearly any extended cluster, since a sloped line across nine equal rows collects mass too. Here the
/// cluster is followed as a whole: for a velocity v, each bin of its extent in the current row is followed
/// back through the rows and counts the second-lowest of the weights met, so that one bad row is forgiven,
/// and what stood there only now and then does not count. The sum over the extent is what persists at v; the
/// integral is the largest over |v| <= the volume's maximum speed, less what persists at rest. Then
/// - a thing at rest has 0 however extended it is, and whatever stands still beside it cancels;
/// - a mover of length L along W that covers D in the window has about min(1, D / L) of its weight;
/// - a thing that is uncovered from one side has 0 too: its leading edge gains as much as its other edge
/// loses. The velocity is refined to a fraction of a step by a parabola. `cluster_weight`: S_p in the
/// histogram's units, > 0. Zero with under three rows.
LineIntegral PersistentLineIntegral(const MotionHistogram& histogram, const ClusterExtent& extent,
                                    double cluster_weight);

/// How a cluster moves, along the best of several directions.
struct ClusterMotion {
  Eigen::Vector3f velocity_mps = Eigen::Vector3f::Zero();  // axes of the current camera, ego-motion taken off
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();     // W, the candidate that was taken; zero: none
  double ratio = 0;  // persistent integral / S_p; compare with kPersistentTau
};

/// The persistent integral of a cluster of the current frame (`points_m`, not empty) on the ball of its own
/// size, for each candidate direction (unit vectors); the largest is taken. V's singular vector alone misses
/// motion across the optical axis: a surface slides along itself there, and depth noise is all that V sees;
/// so the camera's axes or the displacement of features belong among the candidates. `rows`: unweighted
/// clouds, ascending in time, the last is the current frame.
ClusterMotion FindClusterMotion(std::span<const HistogramRow> rows, std::span<const Eigen::Vector3f> points_m,
                                std::span<const Eigen::Vector3f> directions, float max_speed_mps = 1.5F);

}  // namespace orbslam
