// SPDX-License-Identifier: GPL-3.0-or-later
// Writing a noisy colour and a depth picture of 640 x 480 at zlib's levels 1 (make_sequence's) and 6.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include "orbslam/io/image_file.h"

namespace orbslam {
namespace {

cv::Mat Picture(int type) {
  cv::Mat ramp(480, 640, type), noise(480, 640, type);
  for (int v = 0; v < ramp.rows; ++v) ramp.row(v).setTo(cv::Scalar::all(40 + v / 4));
  cv::theRNG().state = 1;
  cv::randn(noise, cv::Scalar::all(6), cv::Scalar::all(2));
  return ramp + noise;
}

void BM_WritePng(benchmark::State& state, int type) {
  const cv::Mat picture = Picture(type);
  for (auto _ : state)
    if (!WritePng("/dev/shm/orbslam_png_bench.png", picture, static_cast<int>(state.range(0))).ok())
      state.SkipWithError("cannot write to /dev/shm");
}
BENCHMARK_CAPTURE(BM_WritePng, color, CV_8UC3)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_WritePng, depth, CV_16UC1)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbslam

BENCHMARK_MAIN();
