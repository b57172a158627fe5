// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/frame_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

const PinholeCamera kCamera{
    640, 480, 517.3, 516.5, 318.6, 255.3, {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};

OrbFeatures RandomFeatures(int count, Rng* rng) {
  OrbFeatures raw;
  for (int i = 0; i < count; ++i) {
    raw.keypoints.push_back(
        {static_cast<float>(rng->Uniform(19, 620)), static_cast<float>(rng->Uniform(19, 460)),
         static_cast<float>(rng->Uniform(0, 360)), 30.0f, static_cast<int>(rng->Below(8))});
    raw.descriptors.push_back({{(*rng)(), (*rng)(), (*rng)(), (*rng)()}});
  }
  return raw;
}

cv::Mat RandomDepth(Rng* rng) {
  const float bad[] = {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity()};
  cv::Mat depth(kCamera.height, kCamera.width, CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth.at<float>(y, x) =
          rng->Below(3) == 0 ? bad[rng->Below(4)] : static_cast<float>(rng->Uniform(1.99, 2.01));  // no jumps
    }
  }
  return depth;
}

FrameFeatures Make(const OrbFeatures& raw, const cv::Mat& depth) {
  return MakeFrameFeatures(raw, depth, kCamera, UndistortedBounds(kCamera), DepthModel());
}

TEST(FrameFeatures, DepthIsThatOfTheRawPixelAndValidOrMinusOne) {
  Rng rng(1);
  const OrbFeatures raw = RandomFeatures(500, &rng);
  const cv::Mat depth = RandomDepth(&rng);
  const FrameFeatures features = Make(raw, depth);
  ASSERT_EQ(features.size(), 500);
  for (int i = 0; i < features.size(); ++i) {
    const cv::Point pixel(static_cast<int>(std::lround(raw.keypoints[i].u)),
                          static_cast<int>(std::lround(raw.keypoints[i].v)));
    const float z = depth.at<float>(pixel);
    EXPECT_EQ(features.HasDepth(i), std::isfinite(z) && z > 0);
    EXPECT_EQ(features.depths_m[i], features.HasDepth(i) ? z : -1.0f);
    const double right =
        features.HasDepth(i) ? features.pixels[i].x - DepthModel().baseline_times_fx / z : -1.0;
    EXPECT_NEAR(features.right_u[i], right, 1e-3);
  }
}

TEST(FrameFeatures, DistortingItsPixelsGivesTheRawOnes) {
  Rng rng(2);
  const OrbFeatures raw = RandomFeatures(200, &rng);
  const FrameFeatures features = Make(raw, {});
  ASSERT_EQ(features.size(), 200);
  for (int i = 0; i < features.size(); ++i) {
    const auto distorted = kCamera.Distort({features.pixels[i].x, features.pixels[i].y});
    EXPECT_NEAR(distorted.x(), raw.keypoints[i].u, 0.05);
    EXPECT_NEAR(distorted.y(), raw.keypoints[i].v, 0.05);
    EXPECT_EQ(features.descriptors[i], raw.descriptors[i]);
    EXPECT_EQ(features.angles_deg[i], raw.keypoints[i].angle_deg);
    EXPECT_EQ(features.levels[i], raw.keypoints[i].level);
    EXPECT_FALSE(features.HasDepth(i));
  }
}

TEST(FrameFeatures, GridHoldsEveryKeypoint) {
  Rng rng(4);
  const FrameFeatures features = Make(RandomFeatures(100, &rng), {});
  std::vector<int> found;
  for (int i = 0; i < features.size(); ++i) {
    features.grid.Near(features.pixels[i].x, features.pixels[i].y, 0.5f, features.pixels, features.levels,
                       features.levels[i], features.levels[i], &found);
    EXPECT_NE(std::find(found.begin(), found.end(), i), found.end());
  }
}

TEST(FrameFeatures, NoKeypointsNoFeatures) { EXPECT_EQ(Make({}, {}).size(), 0); }

}  // namespace
}  // namespace orbslam
