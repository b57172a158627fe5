// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>

#include "orbslam/geometry/rigid3.h"
#include "working_frame.h"

namespace orbslam {

/// A depth image that another is aligned to.
struct IcpTarget {
  const WorkingFrame* frame = nullptr;
  const cv::Mat1b* ignored = nullptr;  // cells, non-zero: moves; may be null
  Rigid3d target_from_base;            // base: the frame in which the unknown pose is expressed
};

struct IcpOptions {
  int stride = 2;                         // cells between the points used
  int iterations = 5;                     //
  double prior_translation_m = 0.004;     // standard deviation of the initial pose ...
  double prior_rotation_rad = 0.006;      // ... about each axis
  float max_distance_m = 0.10f;           // of a pair along the normal: farther is another surface
  float gate_sigma = 3.f;                 // Tukey's scale and the gate of a fit, sigma of the residual
};

struct IcpResult {
  Rigid3d base_from_source;
  int num_pairs = 0;     // points that met a surface
  int num_fitting = 0;   // of them, within the gate
  double FitShare() const { return num_pairs > 0 ? static_cast<double>(num_fitting) / num_pairs : 0; }
};

/// Point-to-plane alignment (Chen and Medioni 1992) with projective association (Blais and Levine 1995) of a
/// source frame's cells to one or several targets at once, about a prior.
IcpResult AlignDepth(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
                     std::span<const IcpTarget> targets, const Rigid3d& base_from_source_prior,
                     const IcpOptions& options);

}  // namespace orbslam
