// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/paper_detector.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "moving_scene.h"
#include "orbslam/dynamic/line_integral.h"

namespace orbslam {
namespace {

/// Frames at 30 Hz; the last one's cloud is kept.
class PaperDetectorTest : public ::testing::Test {
 protected:
  PaperResult Run(const SceneAt& scene, const PaperDetectorOptions& options = {},
                  int num_frames = kMotionHistogramRows) {
    PaperDetector detector(options);
    PaperResult result;
    for (int i = 0; i < num_frames; ++i) {
      Rng rng(1, static_cast<uint64_t>(i));
      const double time_s = (i - num_frames + 1) * kFramePeriodS;
      cloud_ = Observe(scene(time_s), &rng);
      result = detector.Process({time_s, cloud_.points_m, cloud_.pixels}, {});
    }
    return result;
  }

  /// Share of the first box's pixels that are marked.
  double MarkedShare(const PaperResult& result) const {
    double marked = 0;
    double all = 0;
    for (size_t i = 0; i < cloud_.boxes.size(); ++i) {
      if (cloud_.boxes[i] != 0) continue;
      ++all;
      marked +=
          std::binary_search(result.dynamic_pixels.begin(), result.dynamic_pixels.end(), cloud_.pixels[i]);
    }
    return marked / all;
  }

  const PaperObject& NearestObject(const PaperResult& result) const {
    return *std::min_element(result.objects.begin(), result.objects.end(), [](const auto& a, const auto& b) {
      return a.centroid_m.z() < b.centroid_m.z();
    });
  }

  SceneCloud cloud_;
};

TEST_F(PaperDetectorTest, MarksSomeoneWhoComesTowardsTheCamera) {
  for (const bool associated : {false, true}) {
    const PaperResult result = Run(PersonBefore({0, 0, 2}, {0, 0, -0.9}), {.associated_rows = associated});
    ASSERT_FALSE(result.objects.empty());
    const PaperObject& person = NearestObject(result);
    EXPECT_TRUE(person.IsDynamic());
    EXPECT_NEAR(person.velocity_mps.z(), -0.9, 0.1);
    EXPECT_NEAR(person.centroid_m.z(), 1.88, 0.1);
    EXPECT_GT(MarkedShare(result), 0.95);
  }
}

TEST_F(PaperDetectorTest, JudgesNothingBeforeNineFrames) {
  const PaperResult result =
      Run(PersonBefore({0, 0, 2}, {0, 0, -0.9}), PaperDetectorOptions{}, kMotionHistogramRows - 1);
  EXPECT_TRUE(result.objects.empty());
  EXPECT_TRUE(result.dynamic_pixels.empty());
}

TEST_F(PaperDetectorTest, JudgesNoClusterUnderTwoHundredPoints) {
  // A ball-sized box, alone: 10 x 10 voxels.
  const SceneAt scene = [](double time_s) {
    return std::vector<SceneBox>{{{0, 0, 2 - 0.9 * time_s}, {0.1, 0.1, 0.1}}};
  };
  EXPECT_TRUE(Run(scene).objects.empty());
}

/// The published threshold is on raw sums, and those grow with the density of a cluster along W, moving or
/// not. What can be promised is an order: the same thing gives a smaller integral at rest than when it moves.
TEST_F(PaperDetectorTest, AMovingThingHasTheLargerIntegral) {
  const double still = NearestObject(Run(PersonBefore({0, 0, 2}, {0, 0, 0}))).line_integral_ratio;
  const double moving = NearestObject(Run(PersonBefore({0, 0, 2}, {0, 0, -0.6}))).line_integral_ratio;
  EXPECT_GT(moving, still);
}

TEST_F(PaperDetectorTest, TheThresholdDecides) {
  const SceneAt scene = PersonBefore({0, 0, 2}, {0, 0, 0});
  const double ratio = NearestObject(Run(scene)).line_integral_ratio;
  const PaperDetectorOptions strict{.tau = 0.25 * ratio * 1.01};
  EXPECT_NEAR(NearestObject(Run(scene, strict)).line_integral_ratio, 1 / 1.01, 1e-3);
  EXPECT_LT(MarkedShare(Run(scene, strict)), 0.01);
}

TEST_F(PaperDetectorTest, TheCamerasMotionIsNotTheThings) {
  // The same room from a camera that moves forward at 0.6 m/s: all points come nearer.
  const Eigen::Vector3d camera_mps(0, 0, 0.6);
  PaperDetector detector(PaperDetectorOptions{});
  PaperResult result;
  for (int i = 0; i < kMotionHistogramRows; ++i) {
    const double time_s = (i - kMotionHistogramRows + 1) * kFramePeriodS;
    auto boxes = PersonBefore({0, 0, 2}, {0, 0, 0})(time_s);
    for (SceneBox& box : boxes) box.centre -= time_s * camera_mps;
    Rng rng(1, static_cast<uint64_t>(i));
    const SceneCloud cloud = Observe(boxes, &rng);
    result = detector.Process({time_s, cloud.points_m, cloud.pixels},
                              {Eigen::Quaterniond::Identity(), -kFramePeriodS * camera_mps});
  }
  const double with_still_camera = NearestObject(Run(PersonBefore({0, 0, 2}, {0, 0, 0}))).line_integral_ratio;
  EXPECT_NEAR(NearestObject(result).line_integral_ratio, with_still_camera, 0.3 * with_still_camera);
}

TEST_F(PaperDetectorTest, BearsEmptyAndBrokenClouds) {
  PaperDetector detector(PaperDetectorOptions{});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 2 * kMotionHistogramRows; ++i) {
    PaperFrame frame{i * kFramePeriodS, {}, {}};
    if (i % 2 == 0) frame.points_m.assign(1000, Eigen::Vector3f(nan, 0, 1));
    frame.pixel_indices.assign(frame.points_m.size(), 0);
    EXPECT_TRUE(detector.Process(frame, {}).dynamic_pixels.empty());
  }
}

}  // namespace
}  // namespace orbslam
