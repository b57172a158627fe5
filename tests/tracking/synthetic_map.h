// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "orbslam/map/invariants.h"
#include "orbslam/tracking/keyframe_creator.h"
#include "support/matchers.h"
#include "support/random.h"
#include "support/synthetic_view.h"

namespace orbslam::test {

/// A map of a known world: who saw which landmark is known for every keypoint, so that matches can be judged.
class SyntheticMap : public testing::Test {
 protected:
  static constexpr double kMaxErrorM = 0.001, kMaxErrorRad = 0.1 * 3.14159265 / 180;

  SyntheticMap() = default;
  explicit SyntheticMap(std::vector<Landmark> landmarks) : landmarks_(std::move(landmarks)) {}

  /// A frame without pose and points. The landmark that its keypoint i shows is in landmarks_of_[its id][i].
  Frame See(const Rigid3d& camera_from_world) {
    const FrameId id(static_cast<uint32_t>(landmarks_of_.size()));
    SyntheticView view = test::See(sensor_, landmarks_, camera_from_world, &rng_, noise_);
    Frame frame = MakeFrame(id, id.value / 30.0, view, Rigid3d());
    landmarks_of_.push_back(std::move(view.landmarks));
    return frame;
  }

  /// The same with its true pose and the map's points of the landmarks that it sees.
  Frame SeeAndKnow(const Rigid3d& camera_from_world) {
    Frame frame = See(camera_from_world);
    frame.camera_from_world = camera_from_world;
    for (int i = 0; i < frame.features->size(); ++i) {
      const auto it = point_of_.find(LandmarkAt(frame, i));
      if (it != point_of_.end()) frame.points[i] = it->second;
    }
    return frame;
  }

  KeyFrameId AddKeyFrame(Frame* frame, int min_depth_points = 10000) {
    const KeyFrameId id =
        CreateKeyFrame(sensor_, min_depth_points, KeyFrameId(0), Epoch(), frame, &map_).value();
    for (int i = 0; i < frame->features->size(); ++i) {
      if (frame->points[i].IsValid()) point_of_[LandmarkAt(*frame, i)] = frame->points[i];
    }
    return id;
  }

  /// As if the depth camera had seen nothing in that keyframe.
  void ForgetDepths(KeyFrameId keyframe) {
    const auto map = map_.Write();
    auto features = std::make_shared<FrameFeatures>(*map->Find(keyframe)->features);
    std::ranges::fill(features->depths_m, -1.0f);
    std::ranges::fill(features->right_u, -1.0f);
    map->Find(keyframe)->features = features;
  }

  /// Guards last until the end of their statement: this one's ends here.
  uint64_t Epoch() const { return map_.Read()->epoch(); }

  int LandmarkAt(const Frame& frame, int keypoint) const { return landmarks_of_[frame.id.value][keypoint]; }

  /// Share of the frame's points that are the map's points of the landmarks at their keypoints.
  double ShareOfRightPoints(const Frame& frame) const {
    int num_right = 0;
    for (int i = 0; i < frame.features->size(); ++i) {
      const auto it = point_of_.find(LandmarkAt(frame, i));
      num_right += frame.points[i].IsValid() && it != point_of_.end() &&
                   map_.Read()->Resolve(it->second) == frame.points[i];
    }
    return num_right / static_cast<double>(frame.NumPoints());
  }

  int LandmarkAt(const MapData& map, const Observation& observation) const {
    return landmarks_of_[map.Find(observation.keyframe)->frame_id.value][observation.keypoint];
  }

  /// The landmark that all observations of the point show; -1: they disagree.
  int LandmarkOf(const MapData& map, const MapPoint& point) const {
    const int landmark = LandmarkAt(map, point.observations.front());
    const auto agrees = [&](const Observation& o) { return LandmarkAt(map, o) == landmark; };
    return std::ranges::all_of(point.observations, agrees) ? landmark : -1;
  }

  /// Points that are observed as if two landmarks were one.
  int NumMixedPoints() const {
    const auto map = map_.Read();
    int num_mixed = 0;
    for (const MapPoint& point : map->MapPoints()) num_mixed += LandmarkOf(*map, point) < 0;
    return num_mixed;
  }

  std::vector<MapPointId> PointsOf(KeyFrameId keyframe) const {
    std::vector<MapPointId> points;
    const auto map = map_.Read();
    std::ranges::copy_if(map->Find(keyframe)->points, std::back_inserter(points), &MapPointId::IsValid);
    return points;
  }

  void ExpectSound() const { EXPECT_THAT(FindBrokenInvariants(*map_.Read()), testing::IsEmpty()); }

  Rng rng_{31};
  const Sensor sensor_ = KinectSensor();
  ViewNoise noise_{.pixel_px = 0.2, .descriptor_bits = 12};
  const std::vector<Landmark> landmarks_ = RandomLandmarks(sensor_, 1600, &rng_);
  std::vector<std::vector<int>> landmarks_of_;  // index: frame id
  std::map<int, MapPointId> point_of_;          // landmark -> point
  Map map_{MapData(sensor_.pyramid)};
};

}  // namespace orbslam::test
