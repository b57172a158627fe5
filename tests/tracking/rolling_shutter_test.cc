// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/rolling_shutter.h"

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
    return UndoRollingShutter(std::make_shared<const FrameFeatures>(rolled), sensor_, motion_);
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
  const auto features = std::make_shared<const FrameFeatures>(Still());
  EXPECT_EQ(UndoRollingShutter(features, sensor_, MotionModel()), features);
  Move(/*speed=*/1);
  sensor_.camera.readout_s = 0;
  EXPECT_EQ(UndoRollingShutter(features, sensor_, motion_), features);
}

}  // namespace
}  // namespace orbslam::test
