// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/corner_depth.h"

#include <gtest/gtest.h>

#include <limits>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

constexpr float kFrontM = 1.2f, kBackM = 3.0f;

/// Something in front of a wall, left of a column.
cv::Mat Silhouette(int first_column_of_wall) {
  cv::Mat depth_m(48, 64, CV_32FC1, cv::Scalar(kBackM));
  depth_m.colRange(0, first_column_of_wall).setTo(kFrontM);
  return depth_m;
}

float At(const cv::Mat& depth_m, int u, int v) { return CornerDepthM(depth_m, {u, v}, DepthModel()); }

TEST(CornerDepth, OnASilhouetteIsThatOfWhatIsInFront) {
  const cv::Mat depth_m = Silhouette(30);
  for (int u = 20; u < 32; ++u) EXPECT_NEAR(At(depth_m, u, 20), kFrontM, 1e-5) << u;
  for (int u = 32; u < 50; ++u) EXPECT_EQ(At(depth_m, u, 20), kBackM) << u;
}

TEST(CornerDepth, OnASilhouetteIsTheMeanOfItsNoise) {
  Rng rng(1);
  double mean_m = 0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    cv::Mat depth_m = Silhouette(30);
    for (float& z : cv::Mat_<float>(depth_m)) z += static_cast<float>(rng.Uniform(-0.005, 0.005));
    mean_m += At(depth_m, 30, 20) / kRuns;
  }
  EXPECT_NEAR(mean_m, kFrontM, 0.0005) << "the nearest of many would be too near";
}

TEST(CornerDepth, WithinASurfaceIsThatOfThePixel) {
  Rng rng(2);
  cv::Mat depth_m(48, 64, CV_32FC1);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u)  // 45 degrees aslant
      depth_m.at<float>(v, u) =
          2 + 0.004f * static_cast<float>(u) + static_cast<float>(rng.Uniform(-0.01, 0.01));
  }
  for (int u = 0; u < depth_m.cols; ++u) EXPECT_EQ(At(depth_m, u, 7), depth_m.at<float>(7, u));
}

TEST(CornerDepth, IsNoneWhereNothingWasMeasured) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float bad : {0.0f, -1.0f, kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
    cv::Mat depth_m = Silhouette(30);
    depth_m.at<float>(20, 31) = bad;
    EXPECT_EQ(At(depth_m, 31, 20), -1);
    EXPECT_NEAR(At(depth_m, 30, 20), kFrontM, 1e-5) << "nor does it disturb its neighbours";
  }
}

TEST(CornerDepth, IsNoneOutsideAndThereAtTheRim) {
  const cv::Mat depth_m = Silhouette(63);
  for (const cv::Point pixel : {cv::Point(-1, 5), {64, 5}, {5, -1}, {5, 48}})
    EXPECT_EQ(CornerDepthM(depth_m, pixel, DepthModel()), -1);
  for (const cv::Point pixel : {cv::Point(0, 0), {63, 0}, {0, 47}, {63, 47}})
    EXPECT_NEAR(CornerDepthM(depth_m, pixel, DepthModel()), kFrontM, 1e-5);
  EXPECT_EQ(CornerDepthM({}, {0, 0}, DepthModel()), -1);
}

}  // namespace
}  // namespace orbslam
