// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/mapping/point_creator.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

/// Two keyframes with a good baseline that share a third of what they see as points; the rest is not mapped.
class PointCreatorTest : public SyntheticMap {
 protected:
  explicit PointCreatorTest(double baseline_m = 0.25) {
    const Eigen::Vector3d step(baseline_m, 0, 0);
    for (int i = 0; i < 2; ++i) frames_.push_back(SeeAndKnow({Eigen::Quaterniond::Identity(), i * step}));
    AddKeyFrames();
  }

  void AddKeyFrames() {
    for (Frame& frame : frames_) {
      for (int i = 0; i < frame.features->size(); ++i) {
        const auto it = point_of_.find(LandmarkAt(frame, i));
        if (it != point_of_.end()) frame.points[i] = it->second;
      }
      last_ = AddKeyFrame(&frame);
    }
    for (const auto& [landmark, point] : point_of_) {
      if (landmark % 3 > 0) map_.Write()->EraseMapPoint(point);
    }
  }

  int NumUnmappedInBoth() const {
    const std::vector<int>&a = landmarks_of_[0], &b = landmarks_of_[1];
    return static_cast<int>(
        std::ranges::count_if(a, [&](int l) { return l % 3 > 0 && std::ranges::count(b, l) > 0; }));
  }

  /// Standard deviation of a point's depth, seen at the level with a baseline: the virtual stereo pair's, as
  /// rays with less parallax are not used.
  double DepthSigmaM(const KeyFrame& keyframe, int keypoint, double z_m) const {
    const double sigma_px = noise_.pixel_px * sensor_.pyramid.SigmaPx(keyframe.features->levels[keypoint]);
    return std::sqrt(2.0) * sigma_px * z_m * z_m / sensor_.intrinsics.bf;
  }

  const MappingOptions options_;
  std::vector<Frame> frames_;
  KeyFrameId last_;
};

TEST_F(PointCreatorTest, WhatBothSeeAndNobodyMappedBecomesPointsInTheRightPlace) {
  const std::vector<MapPointId> created = CreatePoints(sensor_, options_, last_, &map_);
  EXPECT_GT(std::ssize(created), 0.85 * NumUnmappedInBoth());
  EXPECT_LE(std::ssize(created), NumUnmappedInBoth());
  const auto map = map_.Read();
  for (const MapPointId id : created) {
    const MapPoint& point = *map->Find(id);
    const int landmark = LandmarkOf(*map, point);
    ASSERT_GE(landmark, 0);
    EXPECT_NE(landmark % 3, 0) << "had a point already";
    EXPECT_EQ(point.NumObservations(), 2);
    EXPECT_EQ(point.created_by, last_);
    const auto& [keyframe, keypoint] = point.observations.front();
    const Eigen::Vector3d& truth = landmarks_[landmark].position_world;
    const double sigma_m = DepthSigmaM(*map->Find(keyframe), keypoint, truth.z());
    EXPECT_LT((point.position_world - truth).norm(), 0.001 + 4 * sigma_m);
  }
  EXPECT_THAT(FindBrokenInvariants(*map), testing::IsEmpty());
}

TEST_F(PointCreatorTest, NothingIsLeftForASecondTime) {
  CreatePoints(sensor_, options_, last_, &map_);
  EXPECT_TRUE(CreatePoints(sensor_, options_, last_, &map_).empty());
}

class DepthlessPointCreatorTest : public PointCreatorTest {
 protected:
  DepthlessPointCreatorTest() {
    for (const Frame& frame : frames_) ForgetDepths(KeyFrameId(frame.id.value));
  }
};

TEST_F(DepthlessPointCreatorTest, ParallaxAloneDoesToo) {
  const std::vector<MapPointId> created = CreatePoints(sensor_, options_, last_, &map_);
  EXPECT_GT(std::ssize(created), 0.8 * NumUnmappedInBoth());
  const auto map = map_.Read();
  std::vector<double> errors_m;
  for (const MapPointId id : created) {
    const int landmark = LandmarkOf(*map, *map->Find(id));
    ASSERT_GE(landmark, 0);
    errors_m.push_back((map->Find(id)->position_world - landmarks_[landmark].position_world).norm());
  }
  std::ranges::sort(errors_m);
  EXPECT_LT(errors_m[errors_m.size() / 2], 0.03);
}

class ShortBaselinePointCreatorTest : public PointCreatorTest {
 protected:
  ShortBaselinePointCreatorTest() : PointCreatorTest(0.05) {}
};

TEST_F(ShortBaselinePointCreatorTest, BelowTheVirtualPairsBaselineNothingIsMade) {
  EXPECT_TRUE(CreatePoints(sensor_, options_, last_, &map_).empty());
}

TEST_F(PointCreatorTest, KeypointsThatOnlyLookAlikeGiveNothing) {
  auto features = std::make_shared<FrameFeatures>(*frames_[1].features);
  for (int i = features->size() - 1; i > 0; --i) {  // the same descriptors, elsewhere
    std::swap(features->descriptors[i], features->descriptors[rng_.Below(static_cast<uint32_t>(i + 1))]);
  }
  map_.Write()->Find(last_)->features = features;
  EXPECT_LT(std::ssize(CreatePoints(sensor_, options_, last_, &map_)), 0.02 * NumUnmappedInBoth());
  ExpectSound();
}

TEST_F(PointCreatorTest, AnUnknownKeyFrameIsNoHarm) {
  EXPECT_TRUE(CreatePoints(sensor_, options_, KeyFrameId(9), &map_).empty());
}

}  // namespace
}  // namespace orbslam::test
