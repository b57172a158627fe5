// SPDX-License-Identifier: GPL-3.0-or-later
// Our extractor against cv::ORB::detectAndCompute, on one thread and the same images. The counters of
// BM_Ours: time_ratio, our time over OpenCV's, image by image in turns, and cell_ratio, covered 32 x 32 px
// cells over OpenCV's. Images: up to 30 of $ORBSLAM_DATA/fr1_xyz/rgb, or synthetic ones.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "orbslam/features/orb_extractor.h"
#include "orbslam/util/random.h"

namespace orbslam {
namespace {

constexpr int kFeatures = 1000, kCellPx = 32;
constexpr size_t kImages = 30;

std::vector<cv::Mat> ReadImages(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<cv::Mat> images;
  const size_t step = std::max<size_t>(1, files.size() / kImages);
  for (size_t i = 0; i < files.size(); i += step)
    images.push_back(cv::imread(files[i], cv::IMREAD_GRAYSCALE));
  return images;
}

cv::Mat SyntheticImage(uint64_t seed) {
  Rng rng(seed);
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 300; ++i) {
    const auto x = static_cast<int>(rng.Below(640)), y = static_cast<int>(rng.Below(480));
    const cv::Rect box(x, y, static_cast<int>(4 + rng.Below(60)), static_cast<int>(4 + rng.Below(60)));
    cv::rectangle(image, box, cv::Scalar(rng.Below(256)), cv::FILLED);
  }
  for (int i = 0; i < 640 * 480; ++i) {
    image.data[i] = cv::saturate_cast<uint8_t>(image.data[i] + 2.0 * rng.Gaussian());
  }
  return image;
}

const std::vector<cv::Mat>& Images() {
  static const std::vector<cv::Mat> images = [] {
    cv::setNumThreads(1);
    const char* data = std::getenv("ORBSLAM_DATA");
    if (data != nullptr) return ReadImages(std::filesystem::path(data) / "fr1_xyz" / "rgb");
    std::vector<cv::Mat> synthetic;
    for (uint64_t seed = 0; seed < kImages; ++seed) synthetic.push_back(SyntheticImage(seed));
    return synthetic;
  }();
  return images;
}

struct Run {
  double seconds = 0;
  std::set<std::pair<int, int>> cells;

  void Cover(float u, float v) {
    cells.insert({static_cast<int>(u) / kCellPx, static_cast<int>(v) / kCellPx});
  }
};

// Of this thread's processor time: other programs do not count.
double Now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Function>
double Seconds(Function function) {
  const double start = Now();
  function();
  return Now() - start;
}

Run RunOurs(OrbExtractor* extractor, const cv::Mat& image) {
  Run run;
  OrbFeatures features;
  run.seconds = Seconds([&] { features = extractor->Extract(image); });
  for (const OrbKeypoint& keypoint : features.keypoints) run.Cover(keypoint.u, keypoint.v);
  return run;
}

Run RunOpenCv(cv::ORB* orb, const cv::Mat& image) {
  Run run;
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  run.seconds = Seconds([&] { orb->detectAndCompute(image, cv::noArray(), keypoints, descriptors); });
  for (const cv::KeyPoint& keypoint : keypoints) run.Cover(keypoint.pt.x, keypoint.pt.y);
  return run;
}

void BM_OpenCv(benchmark::State& state) {
  const auto orb = cv::ORB::create(kFeatures, 1.2f, 8);
  size_t i = 0;
  for (auto _ : state) state.SetIterationTime(RunOpenCv(orb.get(), Images()[i++ % Images().size()]).seconds);
}
BENCHMARK(BM_OpenCv)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(2.0);

void BM_Ours(benchmark::State& state) {
  const auto orb = cv::ORB::create(kFeatures, 1.2f, 8);
  OrbExtractor extractor({.num_features = kFeatures});
  double our_seconds = 0, their_seconds = 0, our_cells = 0, their_cells = 0;
  size_t i = 0;
  for (auto _ : state) {
    const cv::Mat& image = Images()[i++ % Images().size()];
    const Run theirs = RunOpenCv(orb.get(), image), ours = RunOurs(&extractor, image);
    state.SetIterationTime(ours.seconds);
    our_seconds += ours.seconds;
    their_seconds += theirs.seconds;
    our_cells += static_cast<double>(ours.cells.size());
    their_cells += static_cast<double>(theirs.cells.size());
  }
  state.counters["time_ratio"] = our_seconds / their_seconds;
  state.counters["cell_ratio"] = our_cells / their_cells;
}
BENCHMARK(BM_Ours)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(2.0);

}  // namespace
}  // namespace orbslam

BENCHMARK_MAIN();
