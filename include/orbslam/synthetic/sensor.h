// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/render/renderer.h"
#include "orbslam/util/random.h"

namespace orbslam {

/// What a real RGB-D camera does to the picture; each can be left out.
struct SensorEffects {
  // Depth
  bool depth_noise = false;       // normal, of DepthModel::SigmaM, and disparity in steps of 1/8 px
  bool depth_range = false;       // nothing nearer than 0.5 m or farther than 8 m
  bool depth_edges = false;       // ragged silhouettes with holes
  bool depth_absorption = false;  // nothing from dark, shiny and grazing surfaces
  bool projector_shadow = false;  // nothing where the projector, beside the camera, does not shine
  // Colour
  bool image_noise = false;
  bool image_blur = false;    // of the lens
  bool exposure = false;      // automatic, and drifting
  bool motion_blur = false;   // an exposure of 1/60 s instead of an instant
  bool light_switch = false;  // half of the light goes off for a while
  // Both
  bool separate_clocks = false;  // depth about 10 ms after colour, both with jitter

  /// All but motion blur and the light switch.
  static SensorEffects Usual();
};

/// CV_32FC1, metres: what a structured-light camera (Kinect, Xtion: Khoshelham and Elberink, Sensors 2012)
/// measures of the view.
cv::Mat MeasureDepth(const GeometryView& view, const PinholeCamera& camera, const SensorEffects& effects,
                     Rng* rng);

/// Changes a CV_8UC3 picture. drift: of the exposure, factor.
void DistortColor(const SensorEffects& effects, double drift, Rng* rng, cv::Mat* bgr);

}  // namespace orbslam
