// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/render/renderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "orbslam/geometry/so3.h"
#include "orbslam/util/random.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

PinholeCamera SmallCamera() {
  PinholeCamera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = 133.7, camera.fy = 134.9, camera.cx = 80.3, camera.cy = 60.9;  // off the middle, on purpose
  return camera;
}

std::unique_ptr<Renderer> MakeRenderer() { return Renderer::Create(SmallCamera()).value(); }

/// A square before a camera that stands at the origin, facing it; right and down as the camera has them.
SceneObject Board(const Vector3d& middle, double half_side, uint8_t label = 0) {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair(-1, -1), std::pair(-1, 1), std::pair(1, 1), std::pair(1, -1)}) {
    mesh.vertices.push_back(
        {Vector3d(half_side * x, half_side * y, 0).cast<float>(), Eigen::Vector3f(0, 0, -1),
         Eigen::Vector2f(0.5f + 0.5f * static_cast<float>(x), 0.5f + 0.5f * static_cast<float>(y))});
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  SceneObject board{std::make_shared<const Mesh>(mesh)};
  board.material.emission = 1;
  board.world_from_mesh.translation = middle;
  board.label = label;
  return board;
}

TEST(Renderer, PictureOfASpotIsWhereTheCameraProjectsIt) {
  const auto renderer = MakeRenderer();
  Rng rng(1);
  constexpr int kSpots = 40;
  Eigen::Vector2d bias(
      0, 0);  // four samples a pixel say each edge to an eighth of a pixel or so; the mean, better
  int num_seen = 0;
  for (int i = 0; i < kSpots; ++i) {
    const Vector3d spot{rng.Uniform(-0.9, 0.9), rng.Uniform(-0.6, 0.6), rng.Uniform(1.8, 4)};
    const Rigid3d world_from_camera{So3Exp({rng.Uniform(-0.05, 0.05), 0.03, rng.Uniform(-1, 1)}),
                                    {0.05, -0.02, 0.1}};
    const SceneObject objects[] = {Board(spot, 0.08)};
    cv::Mat gray;
    cv::extractChannel(renderer->RenderColor(objects, Lighting(), world_from_camera), gray, 1);
    const cv::Moments moments = [&] {
      cv::Moments sums;
      for (int v = 0; v < gray.rows; ++v) {
        for (int u = 0; u < gray.cols; ++u) {
          const double weight = gray.at<uint8_t>(v, u);
          sums.m00 += weight, sums.m10 += u * weight, sums.m01 += v * weight;
        }
      }
      return sums;
    }();
    const Eigen::Vector2d expected = renderer->camera().Project(Inverse(world_from_camera) * spot);
    if (expected.x() < 12 || expected.x() > 148 || expected.y() < 12 || expected.y() > 108) continue;
    ASSERT_GT(moments.m00, 0);
    const Eigen::Vector2d error = Eigen::Vector2d(moments.m10, moments.m01) / moments.m00 - expected;
    EXPECT_LT(error.norm(), 0.2);
    bias += error;
    ++num_seen;
  }
  ASSERT_GT(num_seen, kSpots / 3);
  EXPECT_LT((bias / num_seen).norm(), 0.03);
}

TEST(Renderer, DepthIsThatOfTheSlantedPlaneAtThePixelsCentre) {
  const auto renderer = MakeRenderer();
  SceneObject plane = Board({0, 0, 2.5}, 5, 7);
  plane.world_from_mesh.rotation = So3Exp({0.4, -0.5, 0.2});
  plane.is_moving = true;
  plane.material.infrared = 0.4f;
  const GeometryView view = renderer->RenderGeometry({&plane, 1}, Rigid3d());
  const Vector3d normal = plane.world_from_mesh.rotation * Vector3d::UnitZ();
  for (int v = 0; v < 120; v += 7) {
    for (int u = 0; u < 160; u += 7) {
      const Vector3d ray = renderer->camera().Unproject(u, v, 1);
      const double depth_m = normal.dot(plane.world_from_mesh.translation) / normal.dot(ray);
      ASSERT_NEAR(view.depth_m.at<float>(v, u), depth_m, 5e-4) << u << ' ' << v;
      EXPECT_NEAR(view.cosine.at<uint8_t>(v, u), 255 * std::abs(normal.dot(ray.normalized())), 1.5);
    }
  }
  EXPECT_EQ(cv::countNonZero(view.labels != 7) + cv::countNonZero(view.moving != 255), 0);
  EXPECT_EQ(cv::countNonZero(view.infrared != 102), 0);
}

TEST(Renderer, NearHidesFarInAnyOrderAndNothingIsSeenFromBehind) {
  const auto renderer = MakeRenderer();
  const SceneObject far = Board({0, 0, 3}, 2, 1), near = Board({0, 0, 2}, 0.3, 2);
  SceneObject turned_away = Board({0, 0, 1}, 1, 3);
  turned_away.world_from_mesh.rotation = So3Exp({0, 3.14159265, 0});
  for (const auto& objects : {std::array{far, near, turned_away}, std::array{turned_away, near, far}}) {
    const GeometryView view = renderer->RenderGeometry(objects, Rigid3d());
    EXPECT_EQ(view.labels.at<uint8_t>(61, 80), 2);
    EXPECT_EQ(view.labels.at<uint8_t>(20, 80), 1);
    EXPECT_EQ(cv::countNonZero(view.labels == 3), 0);
  }
}

TEST(Renderer, TextureIsUprightAndLampsLightWhatFacesThem) {
  const auto renderer = MakeRenderer();
  SceneObject board = Board({0, 0, 2}, 1);
  cv::Mat texture(64, 64, CV_8UC3, cv::Scalar::all(200));
  texture(cv::Rect(0, 0, 32, 32)).setTo(cv::Scalar(250, 0, 0));  // blue, top left
  board.material.texture = std::make_shared<const cv::Mat>(texture);
  const cv::Mat shown = renderer->RenderColor({&board, 1}, Lighting(), Rigid3d());
  EXPECT_EQ(shown.at<cv::Vec3b>(30, 40), cv::Vec3b(250, 0, 0));
  EXPECT_EQ(shown.at<cv::Vec3b>(90, 120), cv::Vec3b(200, 200, 200));

  board.material.emission = 0;
  Lighting dark, front, back;
  dark.from_above_bgr = dark.from_below_bgr = {0, 0, 0};
  front = back = dark;
  front.lamps = {{{0, 0, 0.5}, Vector3d::UnitZ(), {1, 1, 1}}};
  back.lamps = {{{0, 0, 3}, -Vector3d::UnitZ(), {1, 1, 1}}};
  const auto mean = [&](const Lighting& light) {
    return cv::mean(renderer->RenderColor({&board, 1}, light, Rigid3d()))[1];
  };
  EXPECT_EQ(mean(dark), 0);
  EXPECT_EQ(mean(back), 0);
  EXPECT_GT(mean(front), 30);
}

TEST(Renderer, ThreadsTakeTurnsAndPicturesDoNotChange) {
  const auto renderer = MakeRenderer();
  const SceneObject objects[] = {Board({0.1, 0, 2}, 0.7, 1)};
  const cv::Mat expected = renderer->RenderColor(objects, Lighting(), Rigid3d());
  std::array<bool, 4> same{};
  {
    std::vector<std::jthread> threads;
    for (bool& ok : same) {
      threads.emplace_back([&] {
        ok = true;
        for (int i = 0; i < 5; ++i) {
          const SceneObject other = Board({0, 0, 1.5}, 0.2 * i);  // a mesh that comes and goes
          renderer->RenderGeometry({&other, 1}, Rigid3d());
          ok = ok &&
               cv::norm(renderer->RenderColor(objects, Lighting(), Rigid3d()), expected, cv::NORM_INF) == 0;
        }
      });
    }
  }
  for (const bool ok : same) EXPECT_TRUE(ok);
}

}  // namespace
}  // namespace orbslam
