// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/past_frame.h"

#include "orbslam/optimization/pose_optimizer.h"

namespace orbslam {
namespace {

constexpr double kMinLeft = 0.5;  // of the sightings: fewer hold a pose worse than all of them did

/// Those whose point is still there, as an optimisation problem; forgets the others.
PoseProblem GatherSightings(const MapData& map, const Sensor& sensor, std::vector<Sighting>* sightings) {
  PoseProblem problem{sensor.intrinsics, {}, {}};
  std::vector<Sighting> left;
  for (Sighting sighting : *sightings) {
    sighting.point = map.Resolve(sighting.point);
    const MapPoint* point = map.Find(sighting.point);
    if (point == nullptr) continue;
    problem.observations.push_back({point->position_world, sighting.pixel.cast<double>(),
                                    sensor.pyramid.InverseVariance(sighting.level)});
    left.push_back(sighting);
  }
  *sightings = std::move(left);
  return problem;
}

}  // namespace

std::vector<Sighting> SightingsOf(const Frame& frame) {
  std::vector<Sighting> sightings;
  const FrameFeatures& features = *frame.features;
  for (int i = 0; i < features.size(); ++i) {
    if (!frame.points[i].IsValid()) continue;
    const cv::Point2f& pixel = features.pixels[i];
    sightings.push_back({frame.points[i], {pixel.x, pixel.y, features.right_u[i]}, features.levels[i]});
  }
  return sightings;
}

bool FindPoseAgain(const Map& map, const Sensor& sensor, PastFrame* frame) {
  const double num_first = static_cast<double>(frame->sightings.size());
  Rigid3d reference_from_world;
  PoseProblem problem;
  {
    const auto guard = map.Read();
    const auto found = guard->CameraFromWorld(frame->reference);
    const KeyFrame* reference = guard->Find(frame->reference);
    if (!found || (reference != nullptr && reference->frame_id == frame->id)) return false;
    reference_from_world = *found;
    problem = GatherSightings(*guard, sensor, &frame->sightings);
  }
  problem.camera_from_world = frame->camera_from_reference * reference_from_world;
  const PoseResult result = OptimizePose(problem);
  if (result.num_inliers == 0 || result.num_inliers < kMinLeft * num_first) return false;
  frame->camera_from_reference = result.camera_from_world * Inverse(reference_from_world);
  frame->pose_information = result.information;
  return true;
}

}  // namespace orbslam
