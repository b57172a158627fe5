// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>

#include "orbslam/dynamic/dynamic_detector_options.h"
#include "orbslam/geometry/rigid3.h"
#include "working_frame.h"

namespace orbslam {

/// A depth image that another is aligned to.
struct IcpTarget {
  const WorkingFrame* frame = nullptr;
  const cv::Mat1b* ignored = nullptr;  // cells, non-zero: moves; may be null
  Rigid3d target_from_base;            // base: the frame in which the unknown pose is expressed
};

struct IcpResult {
  Rigid3d base_from_source;
  int num_pairs = 0;    // points that met a surface
  int num_fitting = 0;  // of them, within the gate
  double FitShare() const { return num_pairs > 0 ? static_cast<double>(num_fitting) / num_pairs : 0; }
};

/// The inverse covariance of independent errors of a rotation and a translation.
Eigen::Matrix<double, 6, 6> IsotropicInformation(double sigma_rotation_rad, double sigma_translation_m);

/// Point-to-plane alignment (Chen and Medioni 1992) with projective association (Blais and Levine 1995) of a
/// source frame's cells to one or several targets at once, about a prior. prior_information: inverse
/// covariance of the prior, rotation (rad) before translation (m), for small motions in the source frame.
IcpResult AlignDepth(const GridCamera& camera, const WorkingFrame& source, const cv::Mat1b* ignored_source,
                     std::span<const IcpTarget> targets, const Rigid3d& base_from_source_prior,
                     const Eigen::Matrix<double, 6, 6>& prior_information, const IcpOptions& options);

}  // namespace orbslam
