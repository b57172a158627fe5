// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "orbslam/map/invariants.h"
#include "orbslam/map/map_data.h"
#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {

/// Features that look random and lie nowhere: enough for a map, which never searches in the image.
inline std::shared_ptr<const FrameFeatures> RandomFeatures(int count, Rng* rng) {
  FrameFeatures features;
  features.pixels.resize(count);
  features.angles_deg.resize(count);
  features.depths_m.assign(count, -1);
  features.right_u.assign(count, -1);
  for (int i = 0; i < count; ++i) {
    features.levels.push_back(static_cast<int>(rng->Below(8)));
    features.descriptors.push_back(RandomDescriptor(rng));
  }
  return std::make_shared<const FrameFeatures>(std::move(features));
}

/// A map under random edits, each of which any thread might make. Keyframes have kNumKeypoints keypoints.
class RandomMap {
 public:
  static constexpr int kNumKeypoints = 30;

  RandomMap(MapData* map, Rng* rng) : map_(map), rng_(rng) {}

  KeyFrameId AddKeyFrame() {
    const KeyFrameId before = RandomKeyFrame();
    const FrameId frame(next_frame_++);
    const KeyFrameId id =
        map_->AddKeyFrame(frame, frame.value / 30.0, RandomMotion(rng_), RandomFeatures(kNumKeypoints, rng_));
    for (int i = 0; i < 10; ++i) AddObservation(RandomPoint(), id);
    if (before.IsValid()) map_->ConnectToSpanningTree(id, before);
    return id;
  }
  MapPointId AddMapPoint() {
    const MapPointId id = map_->AddMapPoint(RandomVector(rng_, 3), RandomKeyFrame());
    while (!AddObservation(id, RandomKeyFrame())) {
      if (++num_futile_ % 100 == 0) AddKeyFrame();  // all keypoints are taken
    }
    for (int i = 0; i < 3; ++i) AddObservation(id, RandomKeyFrame());
    return id;
  }
  bool AddObservation(MapPointId point, KeyFrameId keyframe) {
    if (map_->Find(point) == nullptr) return false;
    return map_->AddObservation(point, keyframe, static_cast<int>(rng_->Below(kNumKeypoints)));
  }
  void EditOnce() {
    const uint32_t what = rng_->Below(100);
    if (what < 4 || map_->num_keyframes() < 3)
      AddKeyFrame();
    else if (what < 30)
      AddMapPoint();
    else if (what < 60)
      AddObservation(RandomPoint(), RandomKeyFrame());
    else if (what < 80)
      map_->RemoveObservation(RandomPoint(), RandomKeyFrame());
    else if (what < 86)
      map_->EraseMapPoint(RandomPoint());
    else if (what < 96)
      map_->FuseMapPoint(RandomPoint(), RandomPoint());
    else if (what < 99)
      map_->EraseKeyFrame(RandomKeyFrame());
    else
      AddLoopEdge();
  }

  /// Any that lives; invalid if none does.
  KeyFrameId RandomKeyFrame() {
    std::vector<KeyFrameId> ids;
    for (const KeyFrame& keyframe : map_->KeyFrames()) ids.push_back(keyframe.id);
    return ids.empty() ? KeyFrameId() : ids[rng_->Below(static_cast<uint32_t>(ids.size()))];
  }
  MapPointId RandomPoint() {
    std::vector<MapPointId> ids;
    for (const MapPoint& point : map_->MapPoints()) ids.push_back(point.id);
    return ids.empty() ? MapPointId() : ids[rng_->Below(static_cast<uint32_t>(ids.size()))];
  }

 private:
  void AddLoopEdge() {
    const KeyFrameId a = RandomKeyFrame(), b = RandomKeyFrame();
    if (a != b && rng_->Below(4) == 0) map_->AddLoopEdge(a, b);  // rare: such keyframes live for ever
  }

  MapData* map_;
  Rng* rng_;
  uint32_t next_frame_ = 0;
  int num_futile_ = 0;
};

}  // namespace orbslam::test
