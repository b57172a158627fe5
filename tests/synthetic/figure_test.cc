// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/figure.h"

#include <gmock/gmock.h>

#include <array>
#include <opencv2/core.hpp>

#include "orbslam/synthetic/actor.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

/// Walks, sits, stands up, and holds his hands somewhere for a while.
Actor Someone(uint64_t seed) {
  const Figure figure(seed, 0);
  GaitPlan plan({{0, 0}, 0}, figure.size().half_stance, figure.size().foot);
  plan.Stand(0.4);
  plan.WalkTo({1.5, 0.5}, 0.3 + 0.1 * static_cast<double>(seed));
  plan.TurnTo(-2);
  plan.SitDown();
  plan.Stand(1);
  plan.StandUp();
  Actor actor(figure, plan, 1, seed);
  actor.Gesture(1);
  const Vector3d left(1.8, 0.6, 1.1), right(1.8, 0.3, 1.1);
  actor.Hold({.from_s = 2,
              .until_s = 4,
              .wrists =
                  [=](double) {
                    return std::array{left, right};
                  },
              .lean = 0.3});
  return actor;
}

class FigureOfSeed : public testing::TestWithParam<uint64_t> {};

TEST_P(FigureOfSeed, PartsMeetAtTheirJoints) {
  const Actor actor = Someone(GetParam());
  for (double t = 0; t < actor.plan().duration_s(); t += 0.02) {
    const BodyPose pose = actor.PoseAt(t);
    for (const BodyJoint& joint : BodyJoints(actor.figure().size())) {
      EXPECT_LT((pose[joint.parent] * joint.in_parent - pose[joint.child].translation).norm(), 1e-3)
          << joint.parent << " - " << joint.child << " at " << t;
    }
  }
}

TEST_P(FigureOfSeed, TheLegsReachTheFeet) {
  const Actor actor = Someone(GetParam());
  for (double t = 0; t < actor.plan().duration_s(); t += 0.02) {
    const GaitState gait = actor.plan().At(t);
    const BodyPose pose = actor.PoseAt(t);
    for (int side = 0; side < 2; ++side) {
      EXPECT_LT((pose[kFootLeft + side].translation - gait.feet[side].ankle).norm(), 1e-3) << "at " << t;
    }
  }
}

TEST_P(FigureOfSeed, NothingGoesThroughTheFloorOrOverTheHead) {
  const Actor actor = Someone(GetParam());
  for (double t = 0; t < actor.plan().duration_s(); t += 0.05) {
    for (const SceneObject& object : actor.ObjectsAt(t)) {
      for (const Vertex& vertex : object.mesh->vertices) {
        const double z = (object.world_from_mesh * Vector3d(vertex.position.cast<double>())).z();
        EXPECT_GT(z, -0.003) << "at " << t;
        EXPECT_LT(z, actor.figure().size().height + 0.06) << "at " << t;
      }
    }
  }
}

TEST_P(FigureOfSeed, MeshesAreClosedToTheEyeAndTextured) {
  const Figure figure(GetParam(), 1);
  for (const SceneObject& object : figure.ObjectsAt({}, 7)) {
    EXPECT_EQ(object.label, 7);
    ASSERT_TRUE(object.material.texture);
    const Mesh& mesh = *object.mesh;
    double volume = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto corner = [&](size_t k) { return mesh.vertices.at(mesh.indices[i + k]).position; };
      volume += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
    }
    EXPECT_GT(volume, 0) << "faces look outwards";
    for (const Vertex& vertex : mesh.vertices) EXPECT_NEAR(vertex.normal.norm(), 1, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FigureOfSeed, testing::Range<uint64_t>(0, 4));

TEST(Figure, SeedsAndOutfitsDiffer) {
  const auto shirt = [](uint64_t seed, int outfit) {
    return Figure(seed, outfit).ObjectsAt({}, 1).at(1).material.texture;
  };
  EXPECT_EQ(cv::norm(*shirt(3, 0), *shirt(3, 0), cv::NORM_INF), 0) << "the same each time";
  for (uint64_t seed = 0; seed < 4; ++seed) {
    const auto a = shirt(seed, 0), b = shirt(seed, 1);
    EXPECT_TRUE(a->size() != b->size() ||
                cv::norm(*a, *b, cv::NORM_L1) > 10.0 * static_cast<double>(a->total()));
  }
}

TEST(Actor, WhoStandsIsBelowTheSpeedOfMovingThings) {
  const Figure figure(5, 0);
  GaitPlan plan({}, figure.size().half_stance, figure.size().foot);
  plan.Stand(1);
  const Actor actor(figure, plan, 1, 5);
  constexpr double kTickS = 1.0 / 30, kMovingSpeed = 0.02;
  for (double t = 0; t < 30; t += 0.37) {
    const auto now = actor.ObjectsAt(t), before = actor.ObjectsAt(t - kTickS);
    for (size_t i = 0; i < now.size(); ++i) {
      for (const Vertex& vertex : now[i].mesh->vertices) {
        const Vector3d x = vertex.position.cast<double>();
        EXPECT_LT((now[i].world_from_mesh * x - before[i].world_from_mesh * x).norm(), kMovingSpeed * kTickS);
      }
    }
  }
}

}  // namespace
}  // namespace orbslam
