// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/mask_warp.h"

#include <gtest/gtest.h>

#include "orbslam/geometry/so3.h"

namespace orbslam {
namespace {

class MaskWarpTest : public testing::Test {
 protected:
  static constexpr float kDepthM = 2;

  MaskWarpTest() {
    last_.mask = Filled(object_);
    image_.depth_m = cv::Mat(480, 640, CV_32FC1, cv::Scalar(kDepthM));
  }
  static cv::Mat Filled(const cv::Rect& rect) {
    cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
    mask(rect) = 255;
    return mask;
  }
  static double IntersectionOverUnion(const cv::Mat& a, const cv::Mat& b) {
    return cv::countNonZero(a & b) / static_cast<double>(cv::countNonZero(a | b));
  }
  void ExpectAt(const cv::Rect& expected, const Rigid3d& now_from_last, double dt_s = 1.0 / 30) const {
    const cv::Mat warped = WarpMask(last_, image_, now_from_last, dt_s, camera_);
    ASSERT_EQ(warped.type(), CV_8UC1);
    EXPECT_GT(IntersectionOverUnion(warped, Filled(expected)), 0.9);
  }

  const PinholeCamera camera_{.width = 640, .height = 480, .fx = 500, .fy = 500, .cx = 320, .cy = 240};
  const cv::Rect object_{200, 120, 160, 200};
  RgbdImage image_;
  DynamicMask last_;
};

TEST_F(MaskWarpTest, WithoutMotionItStaysAndWithoutMaskItIsEmpty) {
  ExpectAt(object_, Rigid3d());
  last_.mask = cv::Mat();
  EXPECT_TRUE(WarpMask(last_, image_, Rigid3d(), 0.1, camera_).empty());
}

TEST_F(MaskWarpTest, FollowsTheCamera) {
  ExpectAt(object_ + cv::Point(25, 0), {Eigen::Quaterniond::Identity(), {0.1, 0, 0}});
  ExpectAt(object_ + cv::Point(0, -20), {So3Exp({20.0 / 500, 0, 0}), {0, 0, 0}});
}

TEST_F(MaskWarpTest, FollowsTheObjectNearestToIt) {
  DynamicObject near, far;
  near.centroid_m = {-0.16, -0.08, kDepthM};
  near.velocity_mps = {1, 0, 0};
  far.centroid_m = {2, 0, 4};
  far.velocity_mps = {-9, 0, 0};
  last_.objects = {far, near};
  ExpectAt(object_ + cv::Point(25, 0), Rigid3d(), 0.1);
}

TEST_F(MaskWarpTest, WhatHasNoDepthMovesWithItsObject) {
  DynamicObject object;
  object.centroid_m = {0, 0, 1};
  last_.objects = {object};
  image_.depth_m = 0;
  ExpectAt(object_ + cv::Point(50, 0), {Eigen::Quaterniond::Identity(), {0.1, 0, 0}});
}

TEST_F(MaskWarpTest, WhatLeavesTheImageOrComesBehindTheCameraIsGone) {
  EXPECT_EQ(
      cv::countNonZero(WarpMask(last_, image_, {Eigen::Quaterniond::Identity(), {9, 0, 0}}, 0.1, camera_)),
      0);
  EXPECT_EQ(
      cv::countNonZero(WarpMask(last_, image_, {Eigen::Quaterniond::Identity(), {0, 0, -3}}, 0.1, camera_)),
      0);
}

}  // namespace
}  // namespace orbslam
