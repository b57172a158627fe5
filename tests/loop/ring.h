// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

#include "orbslam/pipeline/place_index.h"
#include "support/trained_vocabulary.h"
#include "tracking/synthetic_map.h"

namespace orbslam::test {

/// A walk round a circle of 1 m radius, looking outwards at landmarks on all sides, a lap and a bit. The
/// estimated poses drift; what is seen again at the end of the lap is not recognised and mapped twice.
class Ring : public SyntheticMap {
 protected:
  static constexpr int kLap = 24, kExtra = 5;  // keyframes

  Ring() : SyntheticMap(LandmarksAround()) {
    noise_ = {.pixel_px = 0.2, .descriptor_bits = 6};
    for (int i = 0; i < kLap + kExtra; ++i) AddNext();
  }

  static std::vector<Landmark> LandmarksAround() {
    const Sensor sensor = KinectSensor();
    std::vector<Landmark> all;
    for (int i = 0; i < kLap; ++i) {
      Rng rng(17, i);
      for (Landmark& landmark : RandomLandmarks(sensor, 100, &rng)) {
        landmark.position_world = Inverse(Truth(i)) * landmark.position_world;
        all.push_back(landmark);
      }
    }
    return all;
  }

  /// camera_from_world of keyframe i.
  static Rigid3d Truth(int i) {
    const Rigid3d turned{So3Exp({0, 2 * std::numbers::pi * i / kLap, 0}), {0, 0, 0}};
    const Rigid3d out{Eigen::Quaterniond::Identity(), {0, 0, -1}};
    return out * turned * Inverse(out);
  }
  static Rigid3d TrueMotion(int to, int from) { return Truth(to) * Inverse(Truth(from)); }

  Rigid3d Pose(int i) const {
    return map_.Read()->Find(KeyFrameId(static_cast<uint32_t>(i)))->camera_from_world;
  }
  static KeyFrameId Id(int i) { return KeyFrameId(static_cast<uint32_t>(i)); }

  /// Of the keyframes' centres, metres: how far the worst is off, seen from the first.
  double WorstErrorM() const {
    double worst_m = 0;
    for (int i = 0; i < kLap + kExtra; ++i) {
      if (map_.Read()->Find(Id(i)) == nullptr) continue;
      worst_m = std::max(worst_m, (Inverse(Pose(i)).translation - Inverse(Truth(i)).translation).norm());
    }
    return worst_m;
  }

  void FillIndex(PlaceIndex* places) const {
    const auto map = map_.Read();
    for (const KeyFrame& keyframe : map->KeyFrames()) {
      places->Add(keyframe.id, places->Transform(*keyframe.features));
    }
  }

  PlaceIndex places_{Words()};

 private:
  /// Training takes a moment; all rings have the same landmarks.
  static std::shared_ptr<const Vocabulary> Words() {
    static const std::shared_ptr<const Vocabulary> vocabulary = TrainOn(LandmarksAround());
    return vocabulary;
  }

  void AddNext() {
    const int i = static_cast<int>(landmarks_of_.size());
    Frame frame = SeeAndKnow(Truth(i));
    if (i > 0) frame.camera_from_world = kDrift * TrueMotion(i, i - 1) * Pose(i - 1);
    AddKeyFrame(&frame);
    std::map<int, MapPointId> in_view;
    for (int k = 0; k < frame.features->size(); ++k) in_view[LandmarkAt(frame, k)] = frame.points[k];
    point_of_ = std::move(in_view);  // what left the view is forgotten
  }

  const Rigid3d kDrift{So3Exp({0, 0.001, 0}), {0, 0.004, 0}};  // a keyframe
};

}  // namespace orbslam::test
