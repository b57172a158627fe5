// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

/// How a registered depth image is read, and what its values are worth.
struct DepthModel {
  double units_per_metre = 5000;  // DepthMapFactor: TUM stores 5000 units for a metre
  double baseline_times_fx = 40;  // Camera.bf, px * m: of the virtual right camera
  double close_limit_baselines =
      40;  // ThDepth: nearer than this many baselines, depth alone makes a map point

  /// Column at which the virtual right camera sees a point (ORB-SLAM2, Mur-Artal and Tardos 2017, section
  /// III-A).
  double RightCoordinate(double u, double depth_m) const { return u - baseline_times_fx / depth_m; }
  /// Points nearer than this are close: their depth is trusted without a second view. Metres.
  double CloseLimitM(double fx) const { return close_limit_baselines * baseline_times_fx / fx; }
  /// Standard deviation of a Kinect's depth at depth_m, metres (Nguyen, Izadi and Lovell, 3DIMPVT 2012).
  static double SigmaM(double depth_m) { return 0.0012 + 0.0019 * (depth_m - 0.4) * (depth_m - 0.4); }
};

}  // namespace orbslam
