// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/camera/pinhole_camera.h"

#include <gtest/gtest.h>

#include "orbslam/camera/stereo_intrinsics.h"
#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {
namespace {

/// The colour camera of the TUM RGB-D benchmark's fr1 sequences, strongly distorted.
PinholeCamera Fr1() {
  return {640,
          480,
          517.306408,
          516.469215,
          318.643040,
          255.313989,
          {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};
}

PinholeCamera WithoutDistortion(PinholeCamera camera) {
  camera.distortion = {};
  return camera;
}

std::vector<cv::Point2f> PixelsOfTheWholeImage(const PinholeCamera& camera) {
  std::vector<cv::Point2f> pixels;
  for (int v = 0; v < camera.height; v += 7) {
    for (int u = 0; u < camera.width; u += 7)
      pixels.emplace_back(static_cast<float>(u), static_cast<float>(v));
  }
  for (const float u : {0.0f, 639.0f}) pixels.insert(pixels.end(), {{u, 0}, {u, 479}});
  return pixels;
}

TEST(PinholeCamera, DistortInvertsUndistortOverTheWholeImage) {
  const PinholeCamera camera = Fr1();
  const std::vector<cv::Point2f> raw = PixelsOfTheWholeImage(camera), undistorted = camera.Undistort(raw);
  ASSERT_EQ(undistorted.size(), raw.size());
  double largest_shift_px = 0;
  for (size_t i = 0; i < raw.size(); ++i) {
    const Eigen::Vector2d ideal(undistorted[i].x, undistorted[i].y), pixel(raw[i].x, raw[i].y);
    EXPECT_THAT(camera.Distort(ideal), MatrixNear(pixel, 0.05));
    largest_shift_px = std::max(largest_shift_px, (ideal - pixel).norm());
  }
  EXPECT_GT(largest_shift_px, 1) << "the distortion is too weak for this test to mean anything";
}

TEST(PinholeCamera, UndistortInvertsDistort) {
  const PinholeCamera camera = Fr1();
  Rng rng(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d ideal(rng.Uniform(20, 620), rng.Uniform(20, 460));
    const Eigen::Vector2d raw = camera.Distort(ideal);
    const cv::Point2f back =
        camera.Undistort({{static_cast<float>(raw.x()), static_cast<float>(raw.y())}}).front();
    EXPECT_THAT(Eigen::Vector2d(back.x, back.y), MatrixNear(ideal, 0.05));
  }
}

TEST(PinholeCamera, WithoutDistortionNothingMoves) {
  const PinholeCamera camera = WithoutDistortion(Fr1());
  EXPECT_TRUE(Fr1().IsDistorted());
  EXPECT_FALSE(camera.IsDistorted());
  const std::vector<cv::Point2f> raw = PixelsOfTheWholeImage(camera);
  EXPECT_EQ(camera.Undistort(raw), raw);
  EXPECT_THAT(camera.Distort({12.5, 400}), MatrixNear(Eigen::Vector2d(12.5, 400), 1e-12));
}

TEST(PinholeCamera, UndistortOfNothingIsNothing) { EXPECT_TRUE(Fr1().Undistort({}).empty()); }

TEST(PinholeCamera, ProjectInvertsUnproject) {
  const PinholeCamera camera = Fr1();
  Rng rng(4);
  for (int i = 0; i < 200; ++i) {
    const double u = rng.Uniform(-100, 740), v = rng.Uniform(-100, 580), depth_m = rng.Uniform(0.1, 20);
    const Eigen::Vector3d x_camera = camera.Unproject(u, v, depth_m);
    EXPECT_EQ(x_camera.z(), depth_m);
    EXPECT_THAT(camera.Project(x_camera), MatrixNear(Eigen::Vector2d(u, v), 1e-10));
  }
}

TEST(PinholeCamera, BoundsHoldEveryUndistortedCorner) {
  for (const PinholeCamera& camera : {Fr1(), WithoutDistortion(Fr1())}) {
    const ImageBounds bounds = UndistortedBounds(camera);
    for (const cv::Point2f& pixel :
         camera.Undistort({{0.5f, 0.5f}, {639.5f, 0.5f}, {0.5f, 479.5f}, {639.5f, 479.5f}})) {
      EXPECT_TRUE(bounds.Contains(pixel.x, pixel.y)) << pixel.x << " " << pixel.y;
    }
    EXPECT_FALSE(bounds.Contains(bounds.max_u, bounds.min_v)) << "half open";
    EXPECT_TRUE(bounds.Contains(bounds.min_u, bounds.min_v));
  }
}

TEST(StereoIntrinsics, ProjectsLikeTheCameraAndTheDepthModel) {
  const PinholeCamera camera = Fr1();
  const DepthModel depth;
  const StereoIntrinsics intrinsics(camera, depth);
  Rng rng(5);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d x_camera(rng.Uniform(-2, 2), rng.Uniform(-2, 2), rng.Uniform(0.5, 8));
    const Eigen::Vector3d pixel = intrinsics.Project(x_camera);
    EXPECT_THAT(pixel.head<2>(), MatrixNear(camera.Project(x_camera), 1e-10));
    EXPECT_NEAR(pixel.z(), depth.RightCoordinate(pixel.x(), x_camera.z()), 1e-10);
  }
}

TEST(DepthModel, RightCameraStandsOneBaselineToTheRight) {
  const PinholeCamera camera = Fr1();
  const DepthModel depth;
  const Eigen::Vector3d x_left(0.3, -0.2, 2.5), baseline(depth.baseline_times_fx / camera.fx, 0, 0);
  EXPECT_NEAR(depth.RightCoordinate(camera.Project(x_left).x(), x_left.z()),
              camera.Project(x_left - baseline).x(), 1e-10);
  EXPECT_NEAR(depth.CloseLimitM(camera.fx), depth.close_limit_baselines * baseline.x(), 1e-12);
}

TEST(DepthModel, DepthGetsWorseWithDistance) {
  for (double z = 0.5; z < 8; z += 0.1) EXPECT_LT(DepthModel::SigmaM(z), DepthModel::SigmaM(z + 0.1));
}

}  // namespace
}  // namespace orbslam::test
