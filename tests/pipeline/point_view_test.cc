// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/point_view.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

class PointViewTest : public SyntheticMap {
 protected:
  PointViewTest() {
    noise_ = ViewNoise();
    frame_ = SeeAndKnow(RandomMotion(&rng_, 0.05, 0.1));
    AddKeyFrame(&frame_);
  }
  const MapPoint& PointAt(int i) const { return *map_.Read()->Find(frame_.points[i]); }
  /// The point seen from `distance_factor` times as far, along the same ray.
  Rigid3d Farther(int i, double distance_factor) const {
    const Eigen::Vector3d x_camera = frame_.camera_from_world * PointAt(i).position_world;
    return Rigid3d{Eigen::Quaterniond::Identity(), (distance_factor - 1) * x_camera} *
           frame_.camera_from_world;
  }

  Frame frame_;
};

TEST_F(PointViewTest, APointIsExpectedWhereItWasSeen) {
  for (int i = 0; i < frame_.features->size(); ++i) {
    const auto view = PredictView(PointAt(i), frame_.camera_from_world, sensor_);
    ASSERT_TRUE(view);
    const ProjectionQuery& query = view->query;
    EXPECT_NEAR(query.u, frame_.features->pixels[i].x, 1e-3);
    EXPECT_NEAR(query.v, frame_.features->pixels[i].y, 1e-3);
    EXPECT_NEAR(query.right_u, frame_.features->right_u[i], 1e-3);
    EXPECT_LE(query.min_level, frame_.features->levels[i]);
    EXPECT_GE(query.max_level, frame_.features->levels[i]);
    EXPECT_NEAR(view->view_cos, 1, 1e-9);
    EXPECT_EQ(query.descriptor, frame_.features->descriptors[i]);
  }
}

TEST_F(PointViewTest, ComingNearerRaisesTheLevel) {
  for (int i = 0; i < 100; ++i) {
    int last_level = -1;
    for (const double factor : {1.1, 0.9, 0.7, 0.5}) {
      const auto view = PredictView(PointAt(i), Farther(i, factor), sensor_);
      if (!view) continue;
      EXPECT_GE(view->query.max_level, last_level);
      EXPECT_FLOAT_EQ(view->query.radius_px,
                      static_cast<float>(sensor_.pyramid.Scale(view->query.max_level)));
      last_level = view->query.max_level;
    }
  }
}

TEST_F(PointViewTest, NothingIsExpectedOutOfViewOutOfRangeOrFromBehind) {
  const Rigid3d turned_away{So3Exp({0, 3.1, 0}), {0, 0, 0}};
  const Rigid3d turned_aside{So3Exp({0, 1.2, 0}), {0, 0, 0}};
  for (int i = 0; i < 100; ++i) {
    const MapPoint& point = PointAt(i);
    EXPECT_FALSE(PredictView(point, turned_away * frame_.camera_from_world, sensor_));
    EXPECT_FALSE(PredictView(point, turned_aside * frame_.camera_from_world, sensor_));
    const double distance_m = (frame_.camera_from_world * point.position_world).norm();
    EXPECT_FALSE(PredictView(point, Farther(i, 1.3 * point.max_distance_m / distance_m), sensor_));
    EXPECT_FALSE(PredictView(point, Farther(i, 0.7 * point.min_distance_m / distance_m), sensor_));
    // Walk round the point to its other side and look at it from there.
    const Eigen::Vector3d x_camera = frame_.camera_from_world * point.position_world;
    const Rigid3d half_turn{So3Exp({0, 3.14159265, 0}), {0, 0, 0}};
    const Rigid3d opposite = Rigid3d{Eigen::Quaterniond::Identity(), x_camera} * half_turn *
                             Rigid3d{Eigen::Quaterniond::Identity(), -x_camera} * frame_.camera_from_world;
    EXPECT_FALSE(PredictView(point, opposite, sensor_));
  }
}

TEST_F(PointViewTest, TheGateGrowsWithTheLevelAndCountsDepth) {
  FrameFeatures features = *frame_.features;
  for (int i = 0; i < features.size(); ++i) {
    if (features.right_u[i] < 0) continue;  // left of what the virtual right camera sees
    const Eigen::Vector3d x_camera = frame_.camera_from_world * PointAt(i).position_world;
    const auto scale = static_cast<float>(sensor_.pyramid.Scale(features.levels[i]));
    EXPECT_TRUE(IsWithinGate(sensor_, x_camera, features, i));
    EXPECT_FALSE(IsWithinGate(sensor_, -x_camera, features, i));
    const auto shifted_fits = [&](float sigmas) {  // v alone, so that the depth stays right
      FrameFeatures shifted = features;
      shifted.pixels[i].y += sigmas * scale;
      return IsWithinGate(sensor_, x_camera, shifted, i);
    };
    EXPECT_TRUE(shifted_fits(2.7f));  // 2.7^2 < 7.8 < 2.9^2
    EXPECT_FALSE(shifted_fits(2.9f));
    features.right_u[i] += 2.9f * scale;
    EXPECT_FALSE(IsWithinGate(sensor_, x_camera, features, i));
    features.right_u[i] = -1;
    EXPECT_TRUE(shifted_fits(2.4f));  // 2.4^2 < 6.0 < 2.5^2
    EXPECT_FALSE(shifted_fits(2.5f));
  }
}

TEST_F(PointViewTest, WithoutDepthNothingIsRightBeforeTheLens) {
  FrameFeatures features = *frame_.features;
  const Eigen::Vector3d x_camera(0.05, 0.02, 0.3);
  const Eigen::Vector3d pixel = sensor_.intrinsics.Project(x_camera);
  features.pixels[0] = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
  features.right_u[0] = static_cast<float>(pixel.z());
  EXPECT_TRUE(IsWithinGate(sensor_, x_camera, features, 0));
  features.right_u[0] = -1;
  EXPECT_FALSE(IsWithinGate(sensor_, x_camera, features, 0));
  features.pixels[0] = {static_cast<float>(sensor_.intrinsics.cx), static_cast<float>(sensor_.intrinsics.cy)};
  EXPECT_TRUE(IsWithinGate(sensor_, {0, 0, 0.5}, features, 0));
}

TEST_F(PointViewTest, QueriesKnowWhoseTheyAre) {
  PointQueries wanted;
  const MapPoint& point = PointAt(3);
  wanted.Add(point, Rigid3d{So3Exp({0, 3.1, 0}), {0, 0, 0}} * frame_.camera_from_world, sensor_, 2);
  EXPECT_TRUE(wanted.points.empty());
  wanted.Add(point, frame_.camera_from_world, sensor_, 2);
  EXPECT_THAT(wanted.points, testing::ElementsAre(point.id));
  EXPECT_FLOAT_EQ(wanted.queries.at(0).radius_px,
                  2 * PredictView(point, frame_.camera_from_world, sensor_)->query.radius_px);
}

}  // namespace
}  // namespace orbslam::test
