// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/synthetic/room.h"

namespace orbslam {

struct View {
  cv::Mat bgr;  // CV_8UC3
  cv::Mat
      depth_m;  // CV_32FC1, metres along the optical axis at the pixel's centre; 0 where no surface is hit
};

/// What an undistorted camera sees of the surfaces. Colour is the mean of 2 x 2 rays a pixel, depth that of
/// the ray through its centre. The result does not depend on num_threads (>= 1).
///
/// In the picture of a plane, inverse depth and (u, v) / depth are linear in the pixel (the plane's
/// homography), so along a row every rectangle is an interval and the nearest is the one with the greatest
/// inverse depth.
View CastRays(std::span<const Surface> surfaces, const PinholeCamera& camera,
              const Rigid3d& world_from_camera, int num_threads);

}  // namespace orbslam
