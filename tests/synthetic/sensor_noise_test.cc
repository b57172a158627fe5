// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "orbslam/camera/depth_model.h"

namespace orbslam {
namespace {

TEST(KinectNoise, HasTheModelsSigmaAtEveryDepthAndNoBias) {
  for (const float depth : {0.6f, 1.0f, 2.0f, 4.0f, 7.0f}) {
    cv::Mat measured(200, 200, CV_32FC1, cv::Scalar(depth)), mean, sigma;
    Rng rng(1);
    AddKinectNoise(&rng, &measured);
    cv::meanStdDev(measured, mean, sigma);
    const double expected = DepthModel::SigmaM(depth);
    EXPECT_NEAR(mean.at<double>(0), depth, 4 * expected / 200);
    EXPECT_NEAR(sigma.at<double>(0), expected, 0.02 * expected);
  }
}

TEST(KinectNoise, IsQuantisedAndBlindOutsideItsRange) {
  cv::Mat measured = (cv::Mat_<float>(1, 5) << 0.0f, 0.45f, 1.2345678f, 3.3f, 8.5f);
  Rng rng(1);
  AddKinectNoise(&rng, &measured);
  for (const int x : {0, 1, 4}) EXPECT_EQ(measured.at<float>(x), 0.0f);
  for (const int x : {2, 3}) {
    const double units = measured.at<float>(x) * 5000.0;
    EXPECT_GT(units, 0);
    EXPECT_NEAR(units, std::round(units), 0.01);
  }
}

TEST(ImageNoise, HasItsSigmaAndMovesAllChannelsTogether) {
  cv::Mat image(200, 200, CV_8UC3, cv::Scalar(100, 120, 140)), mean, sigma;
  Rng rng(1);
  AddImageNoise(2.0, &rng, &image);
  cv::meanStdDev(image, mean, sigma);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean.at<double>(c), 100 + 20 * c, 0.1);
    EXPECT_NEAR(sigma.at<double>(c), std::sqrt(4.0 + 1.0 / 12.0), 0.05);  // with that of rounding
  }
  for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(image)) ASSERT_EQ(pixel[2] - pixel[0], 40);
}

}  // namespace
}  // namespace orbslam
