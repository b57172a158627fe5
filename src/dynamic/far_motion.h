// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ego_motion.h"
#include "reference_view.h"

namespace orbslam {

/// Two frames, and what was followed from one to the other.
struct FarQuery {
  const ReferenceView& earlier;
  const WorkingFrame& current;
  std::span<const CornerMatch> matches;  // of near and far things
  std::vector<Rigid3d> candidates;       // current_from_earlier, of the colour images
  Rigid3d last_step;  // the camera's motion since the last frame, of which colour and depth see other parts
};

/// How the camera moved if what is far rests, by far corners and far depth together.
struct FarMotion {
  Rigid3d color_current_from_earlier, depth_current_from_earlier;
  double split_m = 0;  // far is what is farther
};

/// Somebody near who sets off or sways before a wall: a camera that goes along with him and turns explains
/// his corners and the wall's alike, and then nothing seems to move. What is far leaves no such choice: its
/// own depth tells how the camera turned. Empty unless half of the near corners contradict it, by more than
/// its covariance explains, and most corners do not.
std::optional<FarMotion> ContradictedFarMotion(const WorkingGrids& grids, const FarQuery& query,
                                               const CameraMotionOptions& options, Rng* rng);

/// By what is farther than split_m, whatever the rest does; empty if it does not tell.
std::optional<FarMotion> FindFarMotion(const WorkingGrids& grids, const FarQuery& query, double split_m,
                                       const CameraMotionOptions& options, Rng* rng);

}  // namespace orbslam
