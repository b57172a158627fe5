// SPDX-License-Identifier: GPL-3.0-or-later
// What somebody outside would write: one class of the top floor, one of the ground floor.
#include <cstdio>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/system/system.h"

int main() {
  orbslam::Rigid3d b_from_a;
  b_from_a.translation.x() = 1;
  const double error_m = (Inverse(b_from_a) * b_from_a).translation.norm();

  orbslam::Settings settings;
  settings.camera.fx = settings.camera.fy = 525;
  settings.camera.cx = 319.5, settings.camera.cy = 239.5;
  orbslam::System slam(settings);
  orbslam::RgbdImage dark;
  dark.gray = cv::Mat::zeros(480, 640, CV_8UC1);
  dark.depth_m = cv::Mat::zeros(480, 640, CV_32FC1);
  const orbslam::FrameReport report = slam.TrackRgbd(dark);
  slam.Shutdown();

  std::printf("error %g m, %s\n", error_m, orbslam::Name(report.state));
  return error_m < 1e-12 && report.state == orbslam::TrackingState::kNotInitialized ? 0 : 1;
}
