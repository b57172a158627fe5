// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// The persistent line integral. Raw sums exceed .25 S_p for nearly any extended cluster: a sloped line
/// across nine equal rows collects mass too. Here each bin first loses its median over the rows, which takes
/// away what stands still; then the cluster is followed as a whole: for a velocity v, each bin of its extent
/// in the current row is followed back through the rows and counts the second-lowest of the values met (so
/// that one bad row forgives, and mass that was there only now and then does not count); the sum over the
/// extent is the integral of v, and the largest over |v| <= the volume's maximum speed is taken. The velocity
/// is refined to a fraction of a step by a parabola. `cluster_weight`: S_p in the histogram's units, > 0.
/// Zero with under three rows.
LineIntegral PersistentLineIntegral(const MotionHistogram& histogram, const ClusterExtent& extent,
                                    double cluster_weight);

}  // namespace orbslam
