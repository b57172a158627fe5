// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/ray_caster.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "orbslam/geometry/so3.h"
#include "orbslam/synthetic/synthetic_sequence.h"
#include "orbslam/util/random.h"

namespace orbslam {
namespace {

/// A picture without two equal texels in a row: blue grows to the right, green downwards.
Texture Ramp() {
  cv::Mat image(64, 64, CV_8UC4);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) image.at<cv::Vec4b>(y, x) = {uint8_t(4 * x), uint8_t(4 * y), 200, 255};
  }
  return Texture(image);
}

/// A rectangle of 2 x 1.5 m straight before a camera at the origin, right and down as the camera has them.
Surface Board(double distance_m) { return {{-1, -0.75, distance_m}, {2, 0, 0}, {0, 1.5, 0}, Ramp()}; }

TEST(RayCaster, DepthIsThatOfThePlaneAndTextureIsUpright) {
  const Surface board[] = {Board(1.5)};
  const PinholeCamera camera = SyntheticCamera(320);
  const View view = CastRays(board, camera, Rigid3d(), 1);
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(-0.8, -0.6, 1.5), {0.8, -0.6, 1.5}, {0.1, 0.5, 1.5}}) {
    const Eigen::Vector2d pixel = camera.Project(x);
    const cv::Point at(static_cast<int>(pixel.x() + 0.5), static_cast<int>(pixel.y() + 0.5));
    ASSERT_TRUE(cv::Rect(0, 0, 320, 240).contains(at));
    EXPECT_NEAR(view.depth_m.at<float>(at), 1.5f, 1e-5f);
    EXPECT_NEAR(view.bgr.at<cv::Vec3b>(at)[0], 4 * 64 * (x.x() + 1) / 2, 4);
    EXPECT_NEAR(view.bgr.at<cv::Vec3b>(at)[1], 4 * 64 * (x.y() + 0.75) / 1.5, 4);
    EXPECT_EQ(view.bgr.at<cv::Vec3b>(at)[2], 200);
  }
}

TEST(RayCaster, NearerSurfacesHideFartherInAnyOrder) {
  const Surface near_last[] = {Board(3), Board(2)}, near_first[] = {Board(2), Board(3)};
  const PinholeCamera camera = SyntheticCamera(64);
  for (const auto& boards : {near_last, near_first}) {
    EXPECT_NEAR(CastRays({boards, 2}, camera, Rigid3d(), 1).depth_m.at<float>(24, 32), 2.0f, 1e-5f);
  }
}

TEST(RayCaster, NothingIsSeenFromBehindOrBesideTheView) {
  const Surface board[] = {Board(2)};
  const PinholeCamera camera = SyntheticCamera(64);
  const auto half_turn = So3Exp({0, 3.14159265358979, 0});
  const Rigid3d looking_away{half_turn, {0, 0, 0}}, from_behind{half_turn, {0, 0, 4}};
  for (const Rigid3d& pose : {looking_away, from_behind}) {
    EXPECT_EQ(cv::countNonZero(CastRays(board, camera, pose, 1).depth_m), 0);
  }
}

TEST(RayCaster, RoomHasNoSeamsFromAnywhere) {
  const auto room = MakeRoom(1, 32);
  Rng rng(7);
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d position{rng.Uniform(-1.7, 1.7), rng.Uniform(-1.3, 1.3), rng.Uniform(0.8, 2.2)};
    const Eigen::Vector3d turn{rng.Uniform(-2, 2), rng.Uniform(-2, 2), rng.Uniform(-2, 2)};
    const View view = CastRays(room, SyntheticCamera(160), {So3Exp(turn), position}, 1);
    EXPECT_EQ(cv::countNonZero(view.depth_m), 160 * 120) << "view " << i;
  }
}

}  // namespace
}  // namespace orbslam
