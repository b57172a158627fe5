// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_corrector.h"
#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

/// Keyframes whose corners are half a pixel off, and so are their points; and frames between them.
class GlobalBundleTest : public SyntheticMap {
 protected:
  static constexpr int kNumKeyFrames = 4, kNumFrames = 60;

  GlobalBundleTest() {
    noise_.pixel_px = 0.5;
    for (int i = 0; i < kNumKeyFrames; ++i) {
      Frame frame = SeeAndKnow(PoseAt(static_cast<double>(i) / (kNumKeyFrames - 1)));
      reference_ = AddKeyFrame(&frame);
    }
    for (int i = 0; i < kNumFrames; ++i) {
      const Rigid3d truth = PoseAt(static_cast<double>(i) / kNumFrames);
      const Frame frame = SeeAndKnow(truth);
      frames_.push_back({frame.id,
                         frame.timestamp_s,
                         reference_,
                         RandomMotion(&rng_, 0.002, 0.005) * truth * Inverse(PoseAt(1)),
                         {},
                         SightingsOf(frame)});
    }
  }
  static Rigid3d PoseAt(double share) { return {So3Exp({0, 0.1 * share, 0}), {0.2 * share, 0, 0}}; }

  bool Adjust(int num_frames) {
    std::vector<const PastFrame*> others;
    for (int i = 0; i < num_frames; ++i) others.push_back(&frames_[i]);
    return AdjustGlobally({}, sensor_, others, {}, &turn_, &map_);
  }
  /// Across the line of sight, root mean square over points that several keyframes see: what pixels tell. How
  /// far they are, depths tell, whose errors many frames share.
  double PointErrorM() const {
    const auto map = map_.Read();
    const Eigen::Vector3d centre_m = Inverse(PoseAt(0.5)).translation;
    double sum = 0, count = 0;
    for (const auto& [landmark, id] : point_of_) {
      const MapPoint* point = map->Find(id);
      if (point == nullptr || point->observations.size() < 2) continue;
      const Eigen::Vector3d truth = landmarks_[landmark].position_world,
                            ray = (truth - centre_m).normalized();
      sum += ray.cross(point->position_world - truth).squaredNorm();
      ++count;
    }
    return std::sqrt(sum / count);
  }

  MapPointId PointOfAllKeyFrames() const {
    const auto map = map_.Read();
    for (const MapPoint& point : map->MapPoints())
      if (point.observations.size() == kNumKeyFrames) return point.id;
    return {};
  }

  EditTurn turn_;
  KeyFrameId reference_;
  std::vector<PastFrame> frames_;
};

TEST_F(GlobalBundleTest, ManyFramesMakePointsExact) {
  ASSERT_TRUE(Adjust(0));
  const double of_keyframes_m = PointErrorM();
  ASSERT_TRUE(Adjust(kNumFrames));
  EXPECT_LT(PointErrorM(), 0.5 * of_keyframes_m) << of_keyframes_m;
  EXPECT_THAT(map_.Read()->Find(reference_)->camera_from_world, Rigid3dNear(PoseAt(1), 0.003, 0.002));
  ExpectSound();
}

TEST_F(GlobalBundleTest, FramesOfAnotherPlaceChangeNothing) {
  ASSERT_TRUE(Adjust(0));
  const double of_keyframes_m = PointErrorM();
  for (PastFrame& frame : frames_) frame.reference = KeyFrameId(1000);
  ASSERT_TRUE(Adjust(kNumFrames));
  EXPECT_NEAR(PointErrorM(), of_keyframes_m, 0.1 * of_keyframes_m);
}

TEST_F(GlobalBundleTest, WhatSwaysIsNoPlaceAndIsErased) {
  const MapPointId swaying = PointOfAllKeyFrames();
  for (size_t i = 0; i < frames_.size(); ++i) {
    for (Sighting& sighting : frames_[i].sightings) {
      if (sighting.point != swaying) continue;
      sighting.pixel.x() +=
          (i % 20 < 10 ? 2.0f : -2.0f) * static_cast<float>(sensor_.pyramid.Scale(sighting.level));
    }
  }
  const int num_points = map_.Read()->num_points();
  ASSERT_TRUE(Adjust(kNumFrames));
  EXPECT_EQ(map_.Read()->Find(swaying), nullptr);
  EXPECT_GT(map_.Read()->num_points(), 0.97 * num_points);
  ExpectSound();
}

}  // namespace
}  // namespace orbslam::test
