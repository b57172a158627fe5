// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/pipeline/messages.h"

namespace orbslam {

/// An earlier frame's mask as it should look now: every masked pixel moves with the camera and with the
/// object nearest to it. What has no depth is taken to be as far as that object. For when the mask of a frame
/// comes too late. image: the earlier frame. CV_8UC1 of its size, or empty as last.mask is.
cv::Mat WarpMask(const DynamicMask& last, const RgbdImage& image, const Rigid3d& now_from_last, double dt_s,
                 const PinholeCamera& camera);

}  // namespace orbslam
