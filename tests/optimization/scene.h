// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "orbslam/camera/stereo_intrinsics.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/geometry/so3.h"
#include "orbslam/util/random.h"

namespace orbslam::test {

/// A Kinect-like camera, 640 x 480.
inline StereoIntrinsics Kinect() {
  StereoIntrinsics k;
  k.fx = 525, k.fy = 520, k.cx = 319.5, k.cy = 239.5, k.bf = 40;
  return k;
}

inline Eigen::Vector3d RandomVector(Rng* rng, double size) {
  return size * Eigen::Vector3d(rng->Gaussian(), rng->Gaussian(), rng->Gaussian());
}

inline Rigid3d RandomMotion(Rng* rng, double angle_rad, double distance_m) {
  return {So3Exp(RandomVector(rng, angle_rad)), RandomVector(rng, distance_m)};
}

/// A point that the camera sees, 1 to 5 m away, in its frame.
inline Eigen::Vector3d RandomVisiblePoint(const StereoIntrinsics& k, Rng* rng) {
  const double z = rng->Uniform(1, 5), u = rng->Uniform(0, 640), v = rng->Uniform(0, 480);
  return {(u - k.cx) / k.fx * z, (v - k.cy) / k.fy * z, z};
}

/// What the camera measures of a point in its frame: u, v and disparity, each with its own error. Without depth,
/// u_right is -1.
inline Eigen::Vector3d Measure(const StereoIntrinsics& k, const Eigen::Vector3d& x, double noise_px,
                               bool has_depth, Rng* rng) {
  const Eigen::Vector3d error_px = RandomVector(rng, noise_px);
  Eigen::Vector3d pixel = k.Project(x) + error_px;
  pixel.z() = has_depth ? pixel.z() + error_px.x() : -1;
  return pixel;
}

}  // namespace orbslam::test
