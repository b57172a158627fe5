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
  const Eigen::Vector3d turn = So3Log(now_from_last.rotation);
  angular_ = turn / dt_s;
  // The camera turns while it moves; the Jacobian undoes that (Sola et al. 2018, equations 172 to 174).
  linear_ = So3LeftJacobian(turn).inverse() * now_from_last.translation / dt_s;
}

Rigid3d MotionModel::Predict(const Rigid3d& camera_from_world, double dt_s) const {
  if (!is_known_) return camera_from_world;
  const Eigen::Vector3d turn = angular_ * dt_s;
  return Rigid3d{So3Exp(turn), So3LeftJacobian(turn) * linear_ * dt_s} * camera_from_world;
}

}  // namespace orbslam
