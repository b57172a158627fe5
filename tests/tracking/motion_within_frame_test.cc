// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/motion_within_frame.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/synthetic_view.h"

namespace orbslam::test {
namespace {

Sensor RollingSensor() {
  Sensor sensor = KinectSensor();
  sensor.camera.distortion = {0.26, -0.95, -0.005, 0.003, 1.16};
  sensor.camera.readout_s = 0.03;
  sensor.bounds = UndistortedBounds(sensor.camera);
  return sensor;
}

class RollingShutterTest : public testing::Test {
 protected:
  /// A hand's motion: half a metre and a radian a second, or without the metres.
  void Move(double speed) {
    const Rigid3d step{So3Exp(0.033 * RandomVector(&rng_, 1)), 0.033 * speed * RandomVector(&rng_, 0.5)};
    motion_.Update(0, Rigid3d(), 0.033, step);
  }

  /// What the middle row's camera sees of random points, ...
  FrameFeatures Still() {
    return *See(sensor_, RandomLandmarks(sensor_, 400, &rng_), Rigid3d(), &rng_).features;
  }

  /// ... and where the rows that reach them while the camera moves do.
  FrameFeatures Roll(const FrameFeatures& still) const {
    FrameFeatures rolled = still;
    for (int i = 0; i < still.size(); ++i) {
      const Eigen::Vector3d x =
          sensor_.camera.Unproject(still.pixels[i].x, still.pixels[i].y, still.depths_m[i]);
      Eigen::Vector3d x_row = x;
      for (int k = 0; k < 20; ++k) {  // the row depends on where it sees the point
        const double row = sensor_.camera.Distort(sensor_.camera.Project(x_row)).y();
        const double after_middle_s = ((row + 0.5) / sensor_.camera.height - 0.5) * sensor_.camera.readout_s;
        x_row = motion_.Predict(Rigid3d(), after_middle_s) * x;
      }
      const Eigen::Vector2f pixel = sensor_.camera.Project(x_row).cast<float>();
      rolled.pixels[i] = {pixel.x(), pixel.y()};
      rolled.depths_m[i] = static_cast<float>(x_row.z());
      rolled.right_u[i] = static_cast<float>(sensor_.depth.RightCoordinate(pixel.x(), x_row.z()));
    }
    return rolled;
  }

  std::shared_ptr<const FrameFeatures> Undo(const FrameFeatures& rolled) const {
    return AtOneInstant({std::make_shared<const FrameFeatures>(rolled), {}, 0}, sensor_, motion_);
  }

  Sensor sensor_ = RollingSensor();
  MotionModel motion_;
  Rng rng_{31};
};

double LargestDistancePx(const FrameFeatures& a, const FrameFeatures& b) {
  double largest = 0;
  for (int i = 0; i < a.size(); ++i) largest = std::max(largest, cv::norm(a.pixels[i] - b.pixels[i]));
  return largest;
}

TEST_F(RollingShutterTest, EveryRowGoesBackToWhereTheMiddleOneSawIt) {
  for (int run = 0; run < 10; ++run) {
    Move(/*speed=*/1);
    const FrameFeatures still = Still(), rolled = Roll(still);
    const auto undone = Undo(rolled);
    EXPECT_GT(LargestDistancePx(rolled, still), 1);
    EXPECT_LT(LargestDistancePx(*undone, still), 0.01);
    for (int i = 0; i < still.size(); ++i) {
      EXPECT_NEAR(undone->depths_m[i], still.depths_m[i], 1e-5);
      EXPECT_NEAR(undone->right_u[i], still.right_u[i], 0.01);
    }
  }
}

TEST_F(RollingShutterTest, ATurningCameraNeedsNoDepth) {
  Move(/*speed=*/0);
  const FrameFeatures still = Still();
  FrameFeatures rolled = Roll(still);
  for (int i = 0; i < still.size(); i += 2) rolled.depths_m[i] = rolled.right_u[i] = -1;
  const auto undone = Undo(rolled);
  EXPECT_LT(LargestDistancePx(*undone, still), 0.01);
  for (int i = 0; i < still.size(); i += 2) {
    EXPECT_FALSE(undone->HasDepth(i));
    EXPECT_LT(undone->right_u[i], 0);
  }
}

TEST_F(RollingShutterTest, KeypointsAreFoundWhereTheyAreNow) {
  Move(/*speed=*/1);
  const auto undone = Undo(Roll(Still()));
  std::vector<int> near;
  for (int i = 0; i < undone->size(); ++i) {
    if (!sensor_.bounds.Contains(undone->pixels[i].x, undone->pixels[i].y)) continue;
    undone->grid.Near(undone->pixels[i].x, undone->pixels[i].y, 0.5f, undone->pixels, undone->levels, 0, 7,
                      &near);
    EXPECT_EQ(std::ranges::count(near, i), 1);
  }
}

TEST_F(RollingShutterTest, NothingChangesAtRestOrWithAllRowsAtOnce) {
  const MovingView view{std::make_shared<const FrameFeatures>(Still()), {}, 0};
  EXPECT_EQ(AtOneInstant(view, sensor_, MotionModel()), view.features);
  Move(/*speed=*/1);
  EXPECT_FALSE(view.IsOfOneInstant(sensor_));
  sensor_.camera.readout_s = 0;
  EXPECT_TRUE(view.IsOfOneInstant(sensor_));
  EXPECT_EQ(AtOneInstant(view, sensor_, motion_), view.features);
}

/// Keypoints on a wall aslant, whose depth is measured before or after the picture.
class LateDepthTest : public RollingShutterTest {
 protected:
  LateDepthTest() { sensor_.camera.readout_s = 0; }

  /// Where the ray through a pixel meets the wall, from a camera that has moved so.
  double WallDepthM(const Eigen::Vector2d& pixel, const Rigid3d& camera_from_start) const {
    const Eigen::Vector3d ray = sensor_.camera.Unproject(pixel.x(), pixel.y(), 1);
    const Rigid3d start_from_camera = Inverse(camera_from_start);
    const Eigen::Vector3d turned = start_from_camera.rotation * ray;
    return (kWallM - kNormal.dot(start_from_camera.translation)) / kNormal.dot(turned);
  }
  cv::Mat WallSeenAfter(double delay_s) const {
    cv::Mat depth_m(sensor_.camera.height, sensor_.camera.width, CV_32FC1);
    const Rigid3d later_from_now = motion_.Predict(Rigid3d(), delay_s);
    for (int v = 0; v < depth_m.rows; ++v) {
      for (int u = 0; u < depth_m.cols; ++u) {
        const cv::Point2f raw(static_cast<float>(u), static_cast<float>(v));
        const cv::Point2f pixel = sensor_.camera.Undistort({raw})[0];
        depth_m.at<float>(v, u) = static_cast<float>(WallDepthM({pixel.x, pixel.y}, later_from_now));
      }
    }
    return depth_m;
  }
  /// What the depth image, as it is, says of keypoints.
  FrameFeatures Read(const cv::Mat& depth_m) {
    OrbFeatures raw;
    for (int i = 0; i < 200; ++i) {
      raw.keypoints.push_back(
          {static_cast<float>(60 + rng_.Below(520)), static_cast<float>(60 + rng_.Below(360)), 0, 30, 0});
      raw.descriptors.emplace_back();
    }
    return MakeFrameFeatures(raw, depth_m, sensor_.camera, sensor_.bounds, sensor_.depth);
  }
  double LargestErrorM(const FrameFeatures& features) const {
    double largest_m = 0;
    for (int i = 0; i < features.size(); ++i) {
      const Eigen::Vector2d pixel(features.pixels[i].x, features.pixels[i].y);
      largest_m = std::max(largest_m, std::abs(features.depths_m[i] - WallDepthM(pixel, Rigid3d())));
    }
    return largest_m;
  }

  const Eigen::Vector3d kNormal = Eigen::Vector3d(0.6, 0.2, 1).normalized();
  static constexpr double kWallM = 2;
};

TEST_F(LateDepthTest, IsCarriedToThePicturesTime) {
  for (const double delay_s : {0.015, -0.015}) {
    Move(/*speed=*/1);
    const cv::Mat depth_m = WallSeenAfter(delay_s);
    const auto raw = std::make_shared<const FrameFeatures>(Read(depth_m));
    const auto features = AtOneInstant({raw, depth_m, delay_s}, sensor_, motion_);
    EXPECT_GT(LargestErrorM(*raw), 0.008);
    EXPECT_LT(LargestErrorM(*features), 0.004) << "half a pixel of a wall aslant";
    EXPECT_LT(LargestDistancePx(*features, *raw), 0.01) << "the picture itself is of one instant";
    for (int i = 0; i < features->size(); ++i) {
      EXPECT_NEAR(features->right_u[i],
                  sensor_.depth.RightCoordinate(features->pixels[i].x, features->depths_m[i]), 1e-3);
    }
  }
}

TEST_F(LateDepthTest, IsFoundWhereThePictureHasNone) {
  Move(/*speed=*/1);
  const cv::Mat depth_m = WallSeenAfter(0.015);
  FrameFeatures raw = Read(depth_m);
  raw.depths_m[0] = raw.right_u[0] = -1;
  const auto features =
      AtOneInstant({std::make_shared<const FrameFeatures>(raw), depth_m, 0.015}, sensor_, motion_);
  EXPECT_LT(LargestErrorM(*features), 0.004);
  const auto without =
      AtOneInstant({std::make_shared<const FrameFeatures>(raw), 0 * depth_m, 0.015}, sensor_, motion_);
  for (int i = 0; i < without->size(); ++i) EXPECT_FALSE(without->HasDepth(i));
}

}  // namespace
}  // namespace orbslam::test
