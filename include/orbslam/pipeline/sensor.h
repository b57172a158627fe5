// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/camera/depth_model.h"
#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/camera/stereo_intrinsics.h"
#include "orbslam/features/orb_extractor.h"
#include "orbslam/features/scale_pyramid.h"

namespace orbslam {

/// Everything about the camera and the feature pyramid that the stages need, worked out once from the
/// settings.
struct Sensor {
  PinholeCamera camera;
  ImageBounds bounds;  // undistorted px
  DepthModel depth;
  StereoIntrinsics intrinsics;
  ScalePyramid pyramid;
  double frame_rate_hz;

  Sensor(const PinholeCamera& pinhole, const DepthModel& depth_model, const OrbExtractorOptions& orb,
         double rate_hz)
      : camera(pinhole),
        bounds(UndistortedBounds(pinhole)),
        depth(depth_model),
        intrinsics(pinhole, depth_model),
        pyramid(orb.num_levels, orb.scale_factor),
        frame_rate_hz(rate_hz) {}
};

}  // namespace orbslam
