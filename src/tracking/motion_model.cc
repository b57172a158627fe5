// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/motion_model.h"

#include "orbslam/geometry/so3.h"

namespace orbslam {

void MotionModel::Update(double last_s, const Rigid3d& last_from_world, double now_s,
                         const Rigid3d& now_from_world) {
  const double dt_s = now_s - last_s;
  is_known_ = dt_s > 0;
  if (!is_known_) return;
  const Rigid3d now_from_last = now_from_world * Inverse(last_from_world);
  angular_ = So3Log(now_from_last.rotation) / dt_s;
  linear_ = now_from_last.translation / dt_s;
}

Rigid3d MotionModel::Predict(const Rigid3d& camera_from_world, double dt_s) const {
  if (!is_known_) return camera_from_world;
  return Rigid3d{So3Exp(angular_ * dt_s), linear_ * dt_s} * camera_from_world;
}

}  // namespace orbslam
