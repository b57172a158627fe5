// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "orbslam/loop/loop_corrector.h"
#include "orbslam/pipeline/map_bundle.h"
#include "orbslam/pipeline/map_correction.h"

namespace orbslam {
namespace {

BundleOptions OfKeyFrames(const LoopOptions& options) {
  return {.solver = BundleOptions::Solver::kSparseSchur,
          .robust_iterations = options.bundle_iterations,
          .final_iterations = 0};
}

// What is bent over seconds costs little, so that only small gains are left to straighten it. With an error
// ratio of 4 silhouettes bend what people walk before; with 2 good points go too, and rooms without people
// lose 5 %. Corners lie on edges, where the error of depth is much the same from frame to frame: believed to
// be independent, a hundred of them bend the room (freiburg1_xyz: 4 % more error). Correlated wholly they
// tell too little where a camera moves in an arc (15 % more).
//
// Measured where nearly every frame sees the same things: with 240 poses the dense solver takes a third of
// the time of the iterative one, which creeps where much is inconsistent; with 550, where nothing is, once
// and a half as long.
BundleOptions OfManyFrames(const LoopOptions& options, size_t num_poses) {
  constexpr size_t kFewPoses = 500;
  return {.solver = num_poses <= kFewPoses ? BundleOptions::Solver::kDenseSchur
                                           : BundleOptions::Solver::kIterativeSchur,
          .robust_iterations = options.bundle_iterations,
          .final_iterations = 3 * options.bundle_iterations,
          .max_point_error_ratio = 3,
          .depth_correlation = 0.1};
}

/// Who sways in his chair was mapped, and silhouettes are nowhere: with many frames it shows.
void ErasePointsWithoutInlier(const MapBundle& bundle, const BundleSummary& summary, MapData* map) {
  std::vector<char> has_inlier(bundle.points.size(), 0);
  for (size_t i = 0; i < summary.is_inlier.size(); ++i)
    has_inlier[bundle.problem.observations[i].point] |= summary.is_inlier[i];
  for (size_t i = 0; i < bundle.points.size(); ++i) {
    if (!has_inlier[i] && map->Find(bundle.points[i]) != nullptr) map->EraseMapPoint(bundle.points[i]);
  }
}

}  // namespace

bool AdjustGlobally(const LoopOptions& options, const Sensor& sensor,
                    std::span<const PastFrame* const> others, std::stop_token stop, EditTurn* turn,
                    Map* map) {
  MapBundle bundle;
  {
    const auto guard = map->Read();
    std::set<KeyFrameId> all;
    for (const KeyFrame& keyframe : guard->KeyFrames()) all.insert(keyframe.id);
    bundle = GatherBundle(*guard, sensor, all, 0);
    for (const PastFrame* frame : others) AddFrame(*guard, sensor, *frame, &bundle);
  }
  const BundleOptions bundle_options =
      others.empty() ? OfKeyFrames(options) : OfManyFrames(options, bundle.problem.poses.size());
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
  if (!others.empty()) ErasePointsWithoutInlier(bundle, summary, &*guard);
  return true;
}

}  // namespace orbslam
