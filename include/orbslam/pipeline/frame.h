// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "orbslam/features/frame_features.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/util/ids.h"

namespace orbslam {

/// A frame while it is tracked: what it saw, where it is thought to be, which map points its keypoints show.
struct Frame {
  FrameId id;
  double timestamp_s = 0;
  std::shared_ptr<const FrameFeatures> features;
  Rigid3d camera_from_world;
  std::vector<MapPointId> points;                // one a keypoint; invalid: none
  Matrix6d pose_information = Matrix6d::Zero();  // UncertainPose's
  bool may_show_movers = true;                   // false: nothing has ever moved before this camera
  double moving_below_m = 0;  // what is nearer moves, for it contradicts what is far (FarPose); 0: nothing

  int NumPoints() const;
  /// So that they can be looked for anew; what a pose over them said is forgotten too.
  void ForgetPoints();
};

}  // namespace orbslam
