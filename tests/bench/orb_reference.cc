// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the median CPU time, in seconds, of cv::ORB::detectAndCompute (1000 features, 8 levels, factor 1.2,
// one thread) over the images of a sequence: the unit in which scripts/benchmark.py gives all other times.
#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>

#include "orbslam/io/image_file.h"
#include "orbslam/io/tum_sequence.h"
#include "orbslam/util/resource_usage.h"

int main(int argc, char** argv) {
  const auto sequence = orbslam::ReadTumSequence(argc == 2 ? argv[1] : "");
  if (!sequence) {
    std::fprintf(stderr, "orb_reference: %s\n", sequence.error().message.c_str());
    return 2;
  }
  cv::setNumThreads(1);
  const auto orb = cv::ORB::create(1000, 1.2f, 8);
  std::vector<double> seconds;
  for (const orbslam::RgbdEntry& entry : sequence->entries) {
    const auto gray = orbslam::ReadGray(entry.rgb_path);
    if (!gray) continue;
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    const orbslam::CpuStopwatch stopwatch;
    orb->detectAndCompute(*gray, cv::noArray(), keypoints, descriptors);
    seconds.push_back(stopwatch.CpuSeconds());
  }
  if (seconds.empty()) return 2;
  std::ranges::sort(seconds);
  std::printf("%.6f\n", seconds[seconds.size() / 2]);
}
