// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_refinement.h"

#include <utility>

#include "orbslam/optimization/absolute_pose.h"
#include "orbslam/optimization/far_pose.h"

namespace orbslam {
namespace {

void ForgetOutliers(const PoseResult& result, const std::vector<int>& keypoints, Frame* frame) {
  for (size_t k = 0; k < keypoints.size(); ++k) {
    if (!result.is_inlier[k]) frame->points[keypoints[k]] = MapPointId();
  }
}

}  // namespace

FramePoseProblem GatherPoseProblem(const Map& map, const Sensor& sensor, Frame* frame) {
  FramePoseProblem gathered{{sensor.intrinsics, frame->camera_from_world, {}}, {}};
  const FrameFeatures& features = *frame->features;
  const auto guard = map.Read();
  for (int i = 0; i < features.size(); ++i) {
    if (!frame->points[i].IsValid()) continue;
    frame->points[i] = guard->Resolve(frame->points[i]);
    const MapPoint* point = guard->Find(frame->points[i]);
    if (point == nullptr) continue;
    const cv::Point2f& pixel = features.pixels[i];
    gathered.problem.observations.push_back({point->position_world,
                                             {pixel.x, pixel.y, features.right_u[i]},
                                             sensor.pyramid.InverseVariance(features.levels[i])});
    gathered.keypoints.push_back(i);
  }
  return gathered;
}

int RefinePose(const Map& map, const Sensor& sensor, NearPoints near, Frame* frame) {
  const auto [problem, keypoints] = GatherPoseProblem(map, sensor, frame);
  PoseResult result = OptimizePose(problem);
  if (near == NearPoints::kDoubted) {
    if (auto far = FindContradictingFarPose(problem, result)) {
      result = std::move(far->pose);
      frame->moving_below_m = far->split_m;
    }
  }
  frame->camera_from_world = result.camera_from_world;
  frame->pose_information = result.information;
  ForgetOutliers(result, keypoints, frame);
  return result.num_inliers;
}

int EstimatePose(const Map& map, const Sensor& sensor, Frame* frame) {
  const auto [problem, keypoints] = GatherPoseProblem(map, sensor, frame);
  Rng rng(/*seed=*/0, frame->id.value);
  const auto estimate = EstimateAbsolutePose(sensor.intrinsics, problem.observations, {}, &rng);
  if (!estimate) return 0;
  frame->camera_from_world = estimate->camera_from_world;
  ForgetOutliers(*estimate, keypoints, frame);
  return RefinePose(map, sensor, NearPoints::kTrusted, frame);
}

}  // namespace orbslam
