// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/camera/depth_model.h"
#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/io/tum_sequence.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// The pictures of one frame, all of the camera's size.
struct RgbdImages {
  cv::Mat gray;     // CV_8UC1
  cv::Mat bgr;      // CV_8UC3; empty unless asked for
  cv::Mat depth_m;  // CV_32FC1, metres along z; 0: no measurement
};

enum class WithColor { kNo, kYes };

/// Error, naming the file, what was found and what was expected: an image that cannot be read, or whose size
/// is not the camera's.
Result<RgbdImages> LoadRgbd(const RgbdEntry& entry, const PinholeCamera& camera,
                            const DepthModel& depth_model, WithColor with_color = WithColor::kNo);

/// CV_16UC1 in the file's units -> CV_32FC1 in metres. 0 is no measurement, and so is 65535: it is where
/// sensors and converters put "too far" and "invalid", and at TUM's 5000 units it would be 13 m, which no
/// such camera sees.
cv::Mat DepthInMetres(const cv::Mat& raw, const DepthModel& depth_model);

}  // namespace orbslam
