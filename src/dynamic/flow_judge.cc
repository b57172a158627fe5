// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_judge.h"

#include <utility>

namespace orbslam {

FrameMotion FlowJudge::Judge(const WorkingFrame& frame, uint64_t seed, SceneHistory* history) {
  FrameMotion motion;
  motion.camera = estimator_.Estimate(*history, frame, seed);
  history->Advance(Inverse(motion.camera.depth_current_from_previous),
                   Inverse(motion.camera.color_current_from_previous));
  history->AlignKeyframes(frame, motion.camera.is_depth_misled);

  const SlowFlowOptions& options = options_.slow_flow;
  const ReferenceView* older = history->KeyframeOfAge(options.age_frames);
  std::optional<Flow> slow, slowest;
  if (options.use_slow_flow && motion.IsTrusted() && older != nullptr) {
    slow = FlowSince(*older, frame, seed, history, &motion.camera);
    const ReferenceView* oldest = history->KeyframeOfAge(options.long_age_frames);
    // What is too blurred over half a second is so over a second too.
    if (slow && oldest != nullptr && oldest != older) slowest = LongFlowSince(*oldest, frame, seed, *history);
  }
  motion.flows.push_back(MakeFlow(motion.camera.corners, options_.corner_gate));
  if (slow) motion.flows.push_back(std::move(*slow));
  if (slowest) motion.flows.push_back(std::move(*slowest));
  return motion;
}

std::optional<Flow> FlowJudge::FlowSince(const ReferenceView& older, const WorkingFrame& frame, uint64_t seed,
                                         SceneHistory* history, CameraMotion* motion) {
  OlderCorners slow = estimator_.FollowFrom(older, *history->Back(1), frame, seed);
  if (slow.current_from_older) history->CorrectColor(older, Inverse(*slow.current_from_older));
  if (slow.far) {
    history->CorrectDepth(older, Inverse(slow.far->depth_current_from_earlier));
    estimator_.FollowFar(*history->Back(1), frame, slow.far->split_m, seed, motion);
  }
  Flow flow = MakeFlow(std::move(slow.corners), options_.slow_flow.gate);
  flow.far_alone_rests = slow.far.has_value();
  if (!flow.far_alone_rests && flow.gate.sharpness < options_.slow_flow.min_sharpness) return {};
  return flow;
}

std::optional<Flow> FlowJudge::LongFlowSince(const ReferenceView& oldest, const WorkingFrame& frame,
                                             uint64_t seed, const SceneHistory& history) const {
  OlderCorners slow = estimator_.FollowFrom(oldest, *history.Back(1), frame, seed);
  Flow flow = MakeFlow(std::move(slow.corners), options_.slow_flow.gate);
  if (slow.far || flow.gate.sharpness < options_.slow_flow.min_sharpness) return {};
  return flow;
}

}  // namespace orbslam
