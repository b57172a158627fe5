// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

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

  Rng rng_{31};
  const Sensor sensor_ = KinectSensor();
  ViewNoise noise_{.pixel_px = 0.2, .descriptor_bits = 12};
  const std::vector<Landmark> landmarks_ = RandomLandmarks(sensor_, 1600, &rng_);
  std::vector<std::vector<int>> landmarks_of_;  // index: frame id
  std::map<int, MapPointId> point_of_;          // landmark -> point
  Map map_{MapData(sensor_.pyramid)};
};

}  // namespace orbslam::test
