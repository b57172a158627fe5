// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "orbslam/camera/depth_model.h"
#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "orbslam/pipeline/dynamic_mask.h"
#include "orbslam/pipeline/messages.h"

namespace orbslam {

/// Finds what moves in a sequence of RGB-D images, from point-cloud motion alone (no learning). Needs nothing
/// but the images: the camera's own motion is estimated inside, so that the mask of a frame does not wait for
/// Tracking. Free of threads; the same images give the same masks.
class DynamicDetector {
 public:
  DynamicDetector(const PinholeCamera& camera, const DepthModel& depth,
                  const DynamicDetectorOptions& options);
  ~DynamicDetector();
  DynamicDetector(DynamicDetector&&) noexcept;
  DynamicDetector& operator=(DynamicDetector&&) noexcept;

  /// Frames in order of time; gray CV_8UC1 raw (possibly distorted), depth_m CV_32FC1 registered to it,
  /// metres, 0 or NaN: no measurement. Never fails: where it cannot tell, the mask is empty and
  /// fail_open_reason says why.
  DynamicMask Process(const RgbdImage& image);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace orbslam
