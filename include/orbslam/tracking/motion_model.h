// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

/// Constant velocity over real time stamps, so that a dropped frame does not halve the prediction.
class MotionModel {
 public:
  /// Two consecutive poses, time stamps in seconds. Equal or falling time stamps forget the velocity.
  void Update(double last_s, const Rigid3d& last_from_world, double now_s, const Rigid3d& now_from_world);
  void Forget() { is_known_ = false; }
  bool IsKnown() const { return is_known_; }

  /// camera_from_world after dt_s more seconds; without a known velocity the camera rests.
  Rigid3d Predict(const Rigid3d& camera_from_world, double dt_s) const;

 private:
  bool is_known_ = false;
  Eigen::Vector3d angular_ = Eigen::Vector3d::Zero();  // rad/s, of now_from_last
  Eigen::Vector3d linear_ = Eigen::Vector3d::Zero();   // m/s
};

}  // namespace orbslam
