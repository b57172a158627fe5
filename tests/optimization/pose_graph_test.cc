// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/pose_graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/numeric_jacobian.h"
#include "optimization/relative_pose_cost.h"
#include "optimization/scene.h"

namespace orbslam {
namespace {

std::vector<double> Coefficients(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
std::vector<double> Coefficients(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

TEST(RelativePoseCost, JacobiansAgreeWithNumericOnes) {
  Rng rng(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Rigid3d a = test::RandomMotion(&rng, 1, 2), b = test::RandomMotion(&rng, 1, 2);
    const double error = trial % 2 == 0 ? 0.5 : 1e-6;  // also where the logarithm is a Taylor series
    const Rigid3d measured = test::RandomMotion(&rng, error, error) * b * Inverse(a);
    const RelativePoseCost cost({0, 1, measured, 0.7}, {});
    test::ExpectJacobiansAreRight(cost,
                                  {Coefficients(a.rotation), Coefficients(a.translation),
                                   Coefficients(b.rotation), Coefficients(b.translation)},
                                  1e-6);
  }
}

TEST(RelativePoseCost, IsZeroWhereThePosesAgree) {
  Rng rng(2);
  const Rigid3d a = test::RandomMotion(&rng, 1, 2), b = test::RandomMotion(&rng, 1, 2);
  const RelativePoseCost cost({0, 1, b * Inverse(a), 1}, {});
  const auto qa = Coefficients(a.rotation), qb = Coefficients(b.rotation);
  const double* parameters[] = {qa.data(), a.translation.data(), qb.data(), b.translation.data()};
  Eigen::Matrix<double, 6, 1> residuals;
  cost.Evaluate(parameters, residuals.data(), nullptr);
  EXPECT_LT(residuals.norm(), 1e-10);
}

// A walk around a circle: odometry drifts the same little bit each step, one edge from the last to the first
// node knows better. Node 0 is fixed.
struct Loop {
  std::vector<Rigid3d> truth;
  PoseGraph graph;
};

Loop DriftingLoop(int n, const Rigid3d& drift) {
  Loop loop;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n;
    loop.truth.push_back({So3Exp({0, angle, 0}), {0, 0, 2}});
  }
  loop.graph.nodes.push_back({loop.truth[0], true});
  for (int i = 1; i < n; ++i) {
    const Rigid3d step = drift * loop.truth[i] * Inverse(loop.truth[i - 1]);
    loop.graph.nodes.push_back({step * loop.graph.nodes.back().camera_from_world, false});
    loop.graph.edges.push_back({i - 1, i, step, 1});
  }
  loop.graph.edges.push_back({n - 1, 0, loop.truth[0] * Inverse(loop.truth[n - 1]), 1000});
  return loop;
}

double ErrorM(const Loop& loop, int i) {
  return (Inverse(loop.graph.nodes[i].camera_from_world).translation - Inverse(loop.truth[i]).translation)
      .norm();
}

TEST(PoseGraph, ClosesTheLoopAndSpreadsTheDrift) {
  const int n = 100;
  Loop loop = DriftingLoop(n, {So3Exp({0, 0.001, 0.0005}), {0.003, 0, 0.001}});
  const double gap_before = ErrorM(loop, n - 1);
  const Rigid3d first = loop.graph.nodes[0].camera_from_world;
  const PoseGraphSummary summary = SolvePoseGraph({}, {}, &loop.graph);
  EXPECT_TRUE(summary.is_usable);
  EXPECT_LT(summary.final_cost, 0.05 * summary.initial_cost);
  EXPECT_GT(gap_before, 0.1);
  EXPECT_LT(ErrorM(loop, n - 1), 0.05 * gap_before);
  for (int i = 1; i < n; ++i) {
    EXPECT_LT(ErrorM(loop, i), 0.6 * gap_before);
    const PoseGraphEdge& edge = loop.graph.edges[i - 1];
    const Rigid3d step =
        loop.graph.nodes[i].camera_from_world * Inverse(loop.graph.nodes[i - 1].camera_from_world);
    EXPECT_LT((step.translation - edge.b_from_a.translation).norm(), 0.01);  // nobody pays more than a share
  }
  EXPECT_EQ(loop.graph.nodes[0].camera_from_world.translation, first.translation);
  EXPECT_EQ(loop.graph.nodes[0].camera_from_world.rotation.coeffs(), first.rotation.coeffs());
}

TEST(PoseGraph, ConsistentEdgesAreMetExactly) {
  Rng rng(3);
  Loop loop = DriftingLoop(30, Rigid3d());
  for (PoseGraphNode& node : loop.graph.nodes) {
    if (!node.is_fixed) node.camera_from_world = test::RandomMotion(&rng, 0.1, 0.1) * node.camera_from_world;
  }
  SolvePoseGraph({}, {}, &loop.graph);
  for (int i = 0; i < 30; ++i) EXPECT_LT(ErrorM(loop, i), 1e-5);
}

TEST(PoseGraph, HubersLossBoundsAWrongEdge) {
  Loop plain = DriftingLoop(30, Rigid3d()), robust = plain;
  for (Loop* loop : {&plain, &robust}) {
    loop->graph.edges.push_back({0, 15, Rigid3d{Eigen::Quaterniond::Identity(), {3, 0, 0}}, 1});
    for (int i = 0; i + 2 < 30; ++i) {
      loop->graph.edges.push_back({i, i + 2, loop->truth[i + 2] * Inverse(loop->truth[i]), 1});
    }
  }
  SolvePoseGraph({.max_iterations = 50}, {}, &plain.graph);
  SolvePoseGraph({.max_iterations = 50, .huber_width = 1}, {}, &robust.graph);
  EXPECT_LT(ErrorM(robust, 15), 0.5 * ErrorM(plain, 15));
}

TEST(PoseGraph, StoppedBeforeItStartsIsNotWorse) {
  Loop loop = DriftingLoop(30, {So3Exp({0, 0.001, 0}), {0.003, 0, 0}});
  std::stop_source stop;
  stop.request_stop();
  const PoseGraphSummary summary = SolvePoseGraph({}, stop.get_token(), &loop.graph);
  EXPECT_LE(summary.final_cost, summary.initial_cost);
}

TEST(PoseGraph, AnEmptyGraphIsSolved) {
  PoseGraph graph;
  EXPECT_TRUE(SolvePoseGraph({}, {}, &graph).is_usable);
}

}  // namespace
}  // namespace orbslam
