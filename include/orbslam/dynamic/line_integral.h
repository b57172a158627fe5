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
/// tau of the persistent integral: half the median of moving clusters (0.12 - 0.15) on recorded sequences;
/// the median of static ones is under 0.01, their 90th percentile 0.09 (nearly all newly seen or of torn
/// edges).
inline constexpr double kPersistentTau = 0.06;

/// The published line integral: a static thing gives the same row nine times, a line without slope, a moving
/// one a sloped line. The largest sum, over the rows, of the bins under a straight line, over all lines whose
/// slope is at most the volume's maximum speed and which leave their first bin by at least one bin within the
/// window (a line that stays inside one bin cannot be told from one without slope). Rows that a line leaves
/// count 0. `cluster_weight`: S_p in the histogram's units, > 0. Zero if the histogram has under two rows.
LineIntegral PublishedLineIntegral(const MotionHistogram& histogram, double cluster_weight);

/// The persistent line integral. Raw sums exceed .25 S_p for nearly any extended cluster, since a sloped line
/// across nine equal rows collects mass too. Here each bin first loses its median over the rows, which takes
/// away what stands still; then the cluster is followed as a whole: for a velocity v, each bin of its extent
/// in the current row is followed back through the nine rows and counts the fourth-lowest of the values met,
/// so that mass counts that was there in six frames of nine. The sum over the extent is the integral of v;
/// the largest over |v| <= the volume's maximum speed is taken. `cluster_weight`: S_p in the histogram's
/// units, > 0. Zero under nine rows. Ranks were chosen by the area under the ROC curve on clusters of what is
/// not confirmed static, in two recorded sequences with rendered people (W: V, x or z): 0.90 and 0.87; with
/// the second-lowest 0.65 and 0.64; the published integral has 0.55 and 0.73. A box that covers less than its
/// own length in the window shows nothing here (its places overlap); people do, because of their limbs.
LineIntegral PersistentLineIntegral(const MotionHistogram& histogram, const ClusterExtent& extent,
                                    double cluster_weight);

/// How much better motion explains the rows than rest: the velocity of a mover, and evidence where everything
/// has been in view for the window. What persists at v is the sum, over the cluster's extent in the current
/// row, of the second-lowest weight that a bin meets when it is followed back at v. The integral is the
/// largest, over |v| <= the volume's maximum speed, of what persists at v less what persists at rest, either
/// where the cluster is now or where it would have been in the oldest row (whichever is more). So a mover
/// must have come to where nothing stood and have left where nothing stands. Then
/// - a thing at rest has 0 however extended it is, and whatever stands still beside it cancels;
/// - a mover of length L along W that covers D in the window has about min(1, D / L) of its weight;
/// - a thing that someone uncovers by walking off has 0 too: what is new of it leads back to where it stands
///   still (up to 0.05 for a surface that leaves the volume to both sides).
/// The velocity is refined to a fraction of a step by a parabola; within 0.1 m/s from 0.3 to 1.2 m/s. As a
/// test it is weaker than the persistent integral when the camera moves (AUC 0.74 and 0.80 on the same
/// sequences): things that enter the view are taken for movers. Zero under nine rows.
LineIntegral GainOverRest(const MotionHistogram& histogram, const ClusterExtent& extent,
                          double cluster_weight);

/// How a cluster moves, along the best of several directions.
struct ClusterMotion {
  Eigen::Vector3f velocity_mps = Eigen::Vector3f::Zero();  // axes of the current camera, ego-motion taken off
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();     // W, the candidate that was taken; zero: none
  double ratio = 0;       // persistent integral / S_p; compare with kPersistentTau
  double gain_ratio = 0;  // gain over rest / S_p, along the same direction
};

/// The persistent integral of a cluster of the current frame (`points_m`, not empty) on the ball of its own
/// size, for each candidate direction (unit vectors); the largest is taken. V's singular vector alone misses
/// motion across the optical axis: a surface slides along itself there, and depth noise is all that V sees;
/// so the camera's axes or the displacement of features belong among the candidates. `rows`: unweighted
/// clouds, ascending in time, the last is the current frame.
ClusterMotion FindClusterMotion(std::span<const HistogramRow> rows, std::span<const Eigen::Vector3f> points_m,
                                std::span<const Eigen::Vector3f> directions, float max_speed_mps = 1.5F);

}  // namespace orbslam
