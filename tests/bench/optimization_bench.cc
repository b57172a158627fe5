// SPDX-License-Identifier: GPL-3.0-or-later
#include <benchmark/benchmark.h>

#include "optimization/bundle_scene.h"
#include "optimization/scene.h"
#include "orbslam/optimization/absolute_pose.h"
#include "orbslam/optimization/pose_graph.h"
#include "orbslam/optimization/pose_optimizer.h"

namespace orbslam {
namespace {

PoseProblem TrackingProblem(int n) {
  Rng rng(1);
  PoseProblem problem{test::Kinect(), test::RandomMotion(&rng, 0.01, 0.01), {}};
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d x = test::RandomVisiblePoint(problem.intrinsics, &rng);
    const Eigen::Vector3d seen = i % 7 == 0 ? test::RandomVisiblePoint(problem.intrinsics, &rng) : x;
    problem.observations.push_back({x, test::Measure(problem.intrinsics, seen, 1, i % 4 != 0, &rng), 1});
  }
  return problem;
}

void BM_OptimizePose(benchmark::State& state) {
  const PoseProblem problem = TrackingProblem(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(OptimizePose(problem));
}
BENCHMARK(BM_OptimizePose)->Arg(100)->Arg(300)->Arg(500)->Unit(benchmark::kMicrosecond);

void RunBundle(const test::BundleSceneOptions& scene_options, BundleOptions options,
               benchmark::State& state) {
  Rng rng(2);
  const test::BundleScene scene = test::MakeBundleScene(scene_options, &rng);
  options.solver = static_cast<BundleOptions::Solver>(state.range(0));
  int iterations = 0;
  for (auto _ : state) {
    BundleProblem problem = scene.problem;
    iterations = SolveBundle(options, {}, &problem).num_iterations;
  }
  state.counters["iterations"] = iterations;
  state.counters["observations"] = static_cast<double>(scene.problem.observations.size());
}

// Argument: 0 dense, 1 sparse Schur complement.
void BM_LocalBundle(benchmark::State& state) {
  RunBundle({.num_fixed_poses = 20, .num_free_poses = 15, .num_points = 2500, .outlier_share = 0.03}, {},
            state);
}
BENCHMARK(BM_LocalBundle)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void BM_GlobalBundle(benchmark::State& state) {
  RunBundle({.num_fixed_poses = 1, .num_free_poses = 299, .num_points = 30000, .outlier_share = 0.01}, {},
            state);
}
BENCHMARK(BM_GlobalBundle)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

// As after a sequence: many frames see the same points. Arguments: 0 dense, 2 iterative; poses.
void BM_BundleOfManyFrames(benchmark::State& state) {
  RunBundle({.num_fixed_poses = 1,
             .num_free_poses = static_cast<int>(state.range(1)) - 1,
             .num_points = 2000,
             .views_per_point = 30,
             .outlier_share = 0.01},
            {}, state);
}
BENCHMARK(BM_BundleOfManyFrames)->ArgsProduct({{0, 2}, {240, 550}})->Unit(benchmark::kMillisecond);

// A drifting walk whose keyframes also know the one five before them; the last one meets the first.
void BM_PoseGraph(benchmark::State& state) {
  Rng rng(3);
  PoseGraph graph;
  graph.nodes.push_back({{}, true});
  for (int i = 1; i < state.range(0); ++i) {
    const Rigid3d step{So3Exp({0, 0.01, 0}), {0.05, 0, 0}};
    graph.nodes.push_back({step * graph.nodes.back().camera_from_world, false});
    for (int j : {i - 1, i - 5}) {
      if (j < 0) continue;
      const Rigid3d b_from_a = graph.nodes[i].camera_from_world * Inverse(graph.nodes[j].camera_from_world);
      graph.edges.push_back({j, i, test::RandomMotion(&rng, 0.001, 0.003) * b_from_a, 1});
    }
  }
  const Rigid3d closing = test::RandomMotion(&rng, 0.05, 0.2) * Inverse(graph.nodes.back().camera_from_world);
  graph.edges.push_back({static_cast<int>(graph.nodes.size()) - 1, 0, closing, 10});
  for (auto _ : state) {
    PoseGraph copy = graph;
    benchmark::DoNotOptimize(SolvePoseGraph({}, {}, &copy));
  }
}
BENCHMARK(BM_PoseGraph)->Arg(300)->Arg(1000)->Unit(benchmark::kMillisecond);

void BM_AbsolutePose(benchmark::State& state) {
  const PoseProblem problem = TrackingProblem(100);
  for (auto _ : state) {
    Rng rng(4);
    benchmark::DoNotOptimize(EstimateAbsolutePose(problem.intrinsics, problem.observations, {}, &rng));
  }
}
BENCHMARK(BM_AbsolutePose)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace orbslam

BENCHMARK_MAIN();
