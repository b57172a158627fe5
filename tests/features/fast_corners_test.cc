// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/fast_corners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <tuple>

#include "fast_kernel.h"
#include "test_images.h"

namespace orbslam {
namespace {

using CornerSet = std::set<std::tuple<int, int, int>>;  // x, y, score

CornerSet OpenCvCorners(const cv::Mat& image, int threshold, int border) {
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(image, keypoints, threshold, true);
  CornerSet corners;
  const cv::Rect area(border, border, image.cols - 2 * border, image.rows - 2 * border);
  for (const auto& k : keypoints) {
    if (area.contains(cv::Point(k.pt))) corners.emplace(k.pt.x, k.pt.y, k.response);
  }
  return corners;
}

CornerSet ToSet(const std::vector<Corner>& corners) {
  CornerSet set;
  for (const Corner& c : corners) set.emplace(c.x, c.y, c.score);
  return set;
}

class FastCornersOfSize : public ::testing::TestWithParam<cv::Size> {};

TEST_P(FastCornersOfSize, WithOneThresholdEqualOpenCvs) {
  for (const uint64_t seed : {1, 2, 3}) {
    for (const cv::Mat& image : {NoiseImage(GetParam(), seed), ShapesImage(GetParam(), seed)}) {
      for (const int threshold : {1, 7, 20, 60}) {
        EXPECT_EQ(ToSet(FastCorners(threshold, threshold).Detect(image, 8)),
                  OpenCvCorners(image, threshold, 8));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, FastCornersOfSize,
                         ::testing::Values(cv::Size(200, 150), cv::Size(73, 40), cv::Size(41, 300),
                                           cv::Size(17, 17)));

TEST(FastCorners, EveryInstructionSetScoresAlike) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "needs AVX2";
  const cv::Mat image = NoiseImage({160, 40}, 5);
  std::vector<uint8_t> scores[2];
  std::vector<uint16_t> peaks[2];
  for (const int k : {0, 1}) {
    const FastKernel& kernel = k == 0 ? kFastSse2 : kFastAvx2;
    scores[k].resize(3 * 128 + 64);
    peaks[k].resize(100);
    for (int y = 0; y < 3; ++y) {
      kernel.score_row(image.ptr(y + 10) + 10, static_cast<ptrdiff_t>(image.step), 128, 7,
                       &scores[k][128 * y + 32]);
      for (auto& score : scores[k]) score = score < 7 ? 0 : score;
    }
    const uint8_t* middle = &scores[k][128 + 32 + 1];
    peaks[k].resize(kernel.find_peaks(middle - 128, middle, middle + 128, 101, 7, peaks[k].data()));
  }
  EXPECT_EQ(scores[0], scores[1]);
  EXPECT_EQ(peaks[0], peaks[1]);
  EXPECT_FALSE(peaks[0].empty());
}

TEST(FastCorners, WeakOnesAreKeptWhereNoStrongOneIsNear) {
  cv::Mat image(300, 300, CV_8UC1, cv::Scalar(100));
  image(cv::Rect(60, 60, 20, 20)).setTo(200);    // strong corners
  image(cv::Rect(64, 64, 6, 6)).setTo(212);      // weak ones beside them
  image(cv::Rect(200, 200, 20, 20)).setTo(115);  // weak ones alone
  cv::GaussianBlur(image, image, {3, 3}, 0.7);   // without ties
  FastCorners both(20, 7), strong_only(20, 20);
  bool weak_alone = false;
  for (const Corner& c : both.Detect(image, 19)) {
    const bool strong = c.score >= 20;
    EXPECT_EQ(strong, c.x < 150);
    weak_alone = weak_alone || !strong;
  }
  EXPECT_TRUE(weak_alone);
  for (const Corner& c : strong_only.Detect(image, 19)) EXPECT_LT(c.x, 150);
}

/// The offsets must make up for most of what the pixels' grid hides of a shift of the whole image.
TEST(FastCorners, PeaksFollowAShiftByPartsOfAPixel) {
  cv::Mat image = ShapesImage({640, 480}, 5);
  cv::GaussianBlur(image, image, {0, 0}, 1);  // as an optic does; a shifted image must not lose more
  const cv::Point2f shift(0.4f, -0.3f);
  cv::Mat shifted;
  cv::warpAffine(image, shifted, cv::Matx23f(1, 0, shift.x, 0, 1, shift.y), image.size(), cv::INTER_CUBIC);
  FastCorners detector(20, 20);
  const std::vector<Corner> before = detector.Detect(image, 19);
  double error_of_peaks = 0, error_of_pixels = 0;
  int num_pairs = 0;
  for (const Corner& now : detector.Detect(shifted, 19))
    for (const Corner& then : before) {
      const cv::Point2f step(static_cast<float>(now.x - then.x), static_cast<float>(now.y - then.y));
      if (cv::norm(step) > 1.5) continue;
      const cv::Point2f finer = step + detector.PeakOffset(shifted, now) - detector.PeakOffset(image, then);
      error_of_pixels += (step - shift).dot(step - shift);
      error_of_peaks += (finer - shift).dot(finer - shift);
      ++num_pairs;
    }
  ASSERT_GT(num_pairs, 200);
  EXPECT_LT(std::sqrt(error_of_peaks / num_pairs), 0.6 * std::sqrt(error_of_pixels / num_pairs));
}

TEST(FastCorners, PeaksStayInTheirPixel) {
  const cv::Mat image = NoiseImage({200, 150}, 7);
  FastCorners detector(20, 7);
  for (const Corner& corner : detector.Detect(image, 19)) {
    const cv::Point2f offset = detector.PeakOffset(image, corner);
    EXPECT_LT(std::max(std::abs(offset.x), std::abs(offset.y)), 0.5f);
  }
}

TEST(FastCorners, StayInsideTheBorder) {
  const cv::Mat image = NoiseImage({100, 80}, 6);
  FastCorners detector(20, 7);
  const std::vector<Corner> corners = detector.Detect(image, 19);
  EXPECT_GT(corners.size(), 20u);
  for (const Corner& c : corners) EXPECT_TRUE(cv::Rect(19, 19, 62, 42).contains({c.x, c.y}));
  EXPECT_TRUE(detector.Detect(image, 40).empty());
}

}  // namespace
}  // namespace orbslam
