// SPDX-License-Identifier: GPL-3.0-or-later
#include <benchmark/benchmark.h>

#include "optimization/scene.h"
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

}  // namespace
}  // namespace orbslam
