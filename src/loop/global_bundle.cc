// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "orbslam/loop/loop_corrector.h"
#include "orbslam/pipeline/map_bundle.h"
#include "orbslam/pipeline/map_correction.h"

namespace orbslam {

bool AdjustGlobally(const LoopOptions& options, const Sensor& sensor, std::stop_token stop, EditTurn* turn,
                    Map* map) {
  MapBundle bundle;
  {
    const auto guard = map->Read();
    std::set<KeyFrameId> all;
    for (const KeyFrame& keyframe : guard->KeyFrames()) all.insert(keyframe.id);
    bundle = GatherBundle(*guard, sensor, all, 0);
  }
  BundleOptions bundle_options;
  bundle_options.solver = BundleOptions::Solver::kSparseSchur;
  bundle_options.robust_iterations = options.bundle_iterations;
  bundle_options.final_iterations = 0;
  const BundleSummary summary = SolveBundle(bundle_options, stop, &bundle.problem);
  if (!summary.is_usable || stop.stop_requested()) return false;

  MapCorrection correction;
  for (size_t i = 0; i < bundle.keyframes.size(); ++i) {
    correction.camera_from_world[bundle.keyframes[i]] = bundle.problem.poses[i].camera_from_world;
  }
  for (size_t i = 0; i < bundle.points.size(); ++i) {
    correction.position_world[bundle.points[i]] = bundle.problem.points[i];
  }
  const auto held = turn->Take();
  const auto guard = map->Write();
  if (guard->epoch() != bundle.epoch) return false;
  CorrectMap(correction, &*guard);
  return true;
}

}  // namespace orbslam
