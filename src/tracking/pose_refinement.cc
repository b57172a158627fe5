// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_refinement.h"

#include "orbslam/optimization/pose_optimizer.h"

namespace orbslam {
namespace {

/// Follows fused points, drops erased ones, and gathers the rest. keypoints: whom each observation belongs to.
PoseProblem Gather(const Map& map, const Sensor& sensor, Frame* frame, std::vector<int>* keypoints) {
  PoseProblem problem{sensor.intrinsics, frame->camera_from_world, {}};
  const FrameFeatures& features = *frame->features;
  const auto guard = map.Read();
  for (int i = 0; i < features.size(); ++i) {
    if (!frame->points[i].IsValid()) continue;
    frame->points[i] = guard->Resolve(frame->points[i]);
    const MapPoint* point = guard->Find(frame->points[i]);
    if (point == nullptr) continue;
    const cv::Point2f& pixel = features.pixels[i];
    problem.observations.push_back({point->position_world, {pixel.x, pixel.y, features.right_u[i]},
                                    sensor.pyramid.InverseVariance(features.levels[i])});
    keypoints->push_back(i);
  }
  return problem;
}

}  // namespace

int RefinePose(const Map& map, const Sensor& sensor, Frame* frame) {
  std::vector<int> keypoints;
  const PoseProblem problem = Gather(map, sensor, frame, &keypoints);
  const PoseResult result = OptimizePose(problem);
  frame->camera_from_world = result.camera_from_world;
  for (size_t k = 0; k < keypoints.size(); ++k) {
    if (!result.is_inlier[k]) frame->points[keypoints[k]] = MapPointId();
  }
  return result.num_inliers;
}

}  // namespace orbslam
