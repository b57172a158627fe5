// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "camera_motion.h"
#include "corner_gate.h"
#include "scene_history.h"

namespace orbslam {

/// How the camera moved, and which corners did otherwise.
struct FrameMotion {
  CameraMotion camera;
  std::vector<Flow> flows;  // from the last frame; from older ones, unless too blurred

  bool IsTrusted() const { return camera.failure.empty(); }
  bool IsSharp() const { return IsTrusted() && flows.front().gate.IsSharp(); }
};

/// Follows corners from the last frame and from keyframes, and brings the history's poses up to date by
/// them.
class FlowJudge {
 public:
  FlowJudge(const WorkingGrids& grids, const DynamicDetectorOptions& options)
      : options_(options), estimator_(grids, options.camera_motion) {}

  /// seed: of the random draws, for example the frame's id.
  FrameMotion Judge(const WorkingFrame& frame, uint64_t seed, SceneHistory* history);
  void Reset() { estimator_.Reset(); }

 private:
  /// Puts the motion since the last frame right if it had followed something near.
  std::optional<Flow> FlowSince(const ReferenceView& older, const WorkingFrame& frame, uint64_t seed,
                                SceneHistory* history, CameraMotion* motion);

  /// Corrects nothing: on the way from so old a keyframe, its own pose is the best guess there is.
  std::optional<Flow> LongFlowSince(const ReferenceView& oldest, const WorkingFrame& frame, uint64_t seed,
                                    const SceneHistory& history) const;

  DynamicDetectorOptions options_;
  CameraMotionEstimator estimator_;
};

}  // namespace orbslam
