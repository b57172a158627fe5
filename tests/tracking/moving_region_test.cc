// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/moving_region.h"

#include <gtest/gtest.h>

#include "support/synthetic_view.h"

namespace orbslam::test {
namespace {

class MovingRegionTest : public testing::Test {
 protected:
  static constexpr float kDepthM = 2;

  MovingRegionTest() { mask_(covered_) = 255; }
  Eigen::Vector3d PointAt(double u, double v, double depth_m = kDepthM) const {
    return sensor_.camera.Unproject(u, v, depth_m);
  }

  const Sensor sensor_ = KinectSensor();
  const cv::Size size_{sensor_.camera.width, sensor_.camera.height};
  const cv::Rect covered_{200, 100, 120, 90};
  cv::Mat mask_ = cv::Mat::zeros(size_, CV_8UC1);
  cv::Mat depth_m_{size_, CV_32FC1, cv::Scalar(kDepthM)};
};

TEST_F(MovingRegionTest, WithoutMaskNothingIsCoveredOrShown) {
  const MovingRegion nothing(sensor_, {}, depth_m_);
  EXPECT_TRUE(nothing.IsEmpty());
  EXPECT_FALSE(nothing.Covers(PointAt(250, 150)));
  EXPECT_FALSE(nothing.Shows(PointAt(250, 150)));
}

TEST_F(MovingRegionTest, CoversExactlyTheMaskAtAnyDepth) {
  const MovingRegion moving(sensor_, mask_, depth_m_);
  for (const double depth_m : {0.5, 2.0, 7.0}) {
    for (int v = 0; v < size_.height; v += 7) {
      for (int u = 0; u < size_.width; u += 7)
        EXPECT_EQ(moving.Covers(PointAt(u, v, depth_m)), covered_.contains({u, v}));
    }
  }
}

TEST_F(MovingRegionTest, ShowsWhatIsOnTheObjectAndNotWhatIsBehindOrAtItsRim) {
  const MovingRegion moving(sensor_, mask_, depth_m_);
  EXPECT_TRUE(moving.Shows(PointAt(250, 150)));
  EXPECT_TRUE(moving.Shows(PointAt(250, 150, kDepthM + 0.01)));
  EXPECT_FALSE(moving.Shows(PointAt(250, 150, 3)));
  EXPECT_FALSE(moving.Shows(PointAt(250, 150, 1)));
  EXPECT_FALSE(moving.Shows(PointAt(202, 150)));
  EXPECT_FALSE(moving.Shows(PointAt(100, 150)));
}

TEST_F(MovingRegionTest, MayShowWhatTheObjectHasLeftByAStep) {
  const MovingRegion moving(sensor_, mask_, depth_m_);
  for (const double step_m : {-0.1, 0.0, 0.1}) {
    EXPECT_TRUE(moving.MayShow(PointAt(250, 150, kDepthM + step_m))) << step_m;
    EXPECT_EQ(moving.Shows(PointAt(250, 150, kDepthM + step_m)), step_m == 0);
  }
  EXPECT_FALSE(moving.MayShow(PointAt(250, 150, kDepthM + 0.5))) << "hidden by it";
  EXPECT_FALSE(moving.MayShow(PointAt(202, 150))) << "at its rim";
  EXPECT_FALSE(moving.MayShow(PointAt(100, 150)));
}

TEST_F(MovingRegionTest, NothingIsShownWhereThereIsNoDepth) {
  depth_m_ = 0;
  const MovingRegion moving(sensor_, mask_, depth_m_);
  EXPECT_TRUE(moving.Covers(PointAt(250, 150)));
  EXPECT_FALSE(moving.Shows(PointAt(250, 150)));
}

TEST_F(MovingRegionTest, SeesThroughWhatIsClearlyBeforeAllThatIsMeasured) {
  for (const cv::Mat& mask : {cv::Mat(), mask_}) {
    const MovingRegion moving(sensor_, mask, depth_m_);
    EXPECT_TRUE(moving.SeesThrough(PointAt(100, 300, 1)));
    EXPECT_TRUE(moving.SeesThrough(PointAt(100, 300, kDepthM - 0.1)));
    EXPECT_FALSE(moving.SeesThrough(PointAt(100, 300, kDepthM - 0.03))) << "no limb is so thin";
    EXPECT_FALSE(moving.SeesThrough(PointAt(100, 300, kDepthM + 1))) << "hidden";
  }
}

TEST_F(MovingRegionTest, DoesNotSeeThroughWhatMovesOrIsCloseBy) {
  const cv::Rect pole{400, 0, 3, size_.height};
  depth_m_(pole) = 1.2;
  const MovingRegion moving(sensor_, mask_, depth_m_);
  EXPECT_FALSE(moving.SeesThrough(PointAt(260, 145, 1))) << "masked";
  for (const double u : {394, 401, 407}) EXPECT_FALSE(moving.SeesThrough(PointAt(u, 300, 1.2))) << u;
  EXPECT_TRUE(moving.SeesThrough(PointAt(401, 300, 0.8))) << "the pole is behind";
  EXPECT_TRUE(moving.SeesThrough(PointAt(420, 300, 1.2)));
}

TEST_F(MovingRegionTest, SeesThroughNothingWhereDepthIsUnknown) {
  EXPECT_FALSE(MovingRegion(sensor_, mask_, {}).SeesThrough(PointAt(100, 300, 1)));
  depth_m_.colRange(0, 101) = 0;
  EXPECT_FALSE(MovingRegion(sensor_, mask_, depth_m_).SeesThrough(PointAt(100, 300, 1)));
  EXPECT_TRUE(MovingRegion(sensor_, mask_, depth_m_).SeesThrough(PointAt(106, 300, 1)));
}

TEST_F(MovingRegionTest, MasksAreThoseOfTheDistortedImage) {
  Sensor distorted = sensor_;
  distorted.camera.distortion = {0.26, -0.95, -0.005, 0.003, 1.16};
  const MovingRegion moving(distorted, mask_, depth_m_);
  const auto undistorted = distorted.camera.Undistort({{202.f, 102.f}, {198.f, 102.f}});
  EXPECT_TRUE(moving.Covers(PointAt(undistorted[0].x, undistorted[0].y)));
  EXPECT_FALSE(moving.Covers(PointAt(undistorted[1].x, undistorted[1].y)));
}

}  // namespace
}  // namespace orbslam::test
