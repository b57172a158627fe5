// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/synthetic_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace orbslam {
namespace {

SyntheticSequenceOptions Small(Motion motion) {
  SyntheticSequenceOptions options;
  options.motion = motion;
  options.camera = SyntheticCamera(320);
  options.texels_per_metre = 128;
  return options;
}

/// Bilinear between the four neighbours; pixel must be inside by one.
float Interpolate(const cv::Mat_<float>& image, const Eigen::Vector2d& pixel) {
  cv::Mat patch;
  cv::getRectSubPix(image, {1, 1}, {float(pixel.x()), float(pixel.y())}, patch);
  return patch.at<float>(0);
}

cv::Mat_<float> Smooth(const cv::Mat& gray) {
  cv::Mat smooth;
  cv::GaussianBlur(gray, smooth, {3, 3}, 0);
  return smooth;
}

struct Covisible {
  std::vector<double> depth_errors_m;
  std::vector<float> gray_a, gray_b;

  double MedianDepthErrorM() {
    const auto middle = depth_errors_m.begin() + depth_errors_m.size() / 2;
    std::nth_element(depth_errors_m.begin(), middle, depth_errors_m.end());
    return *middle;
  }
  double GrayCorrelation() const {
    cv::Mat correlation;
    cv::matchTemplate(cv::Mat(gray_a), cv::Mat(gray_b), correlation, cv::TM_CCOEFF_NORMED);
    return correlation.at<float>(0);
  }
};

/// Frame a's pixels, moved into frame b by depth and ground truth, where b does not see something nearer.
Covisible Compare(const PinholeCamera& camera, const SyntheticFrame& a, const SyntheticFrame& b) {
  constexpr double kOccludedM = 0.05;
  const Rigid3d b_from_a = Inverse(b.world_from_camera) * a.world_from_camera;
  const cv::Mat_<float> gray_a = Smooth(a.gray), gray_b = Smooth(b.gray);
  Covisible result;
  for (int v = 0; v < camera.height; v += 3) {
    for (int u = 0; u < camera.width; u += 3) {
      const Eigen::Vector3d x = b_from_a * camera.Unproject(u, v, a.depth_m.at<float>(v, u));
      const Eigen::Vector2d pixel = camera.Project(x);
      const bool inside = x.z() > 0 && (pixel.array() >= 1).all() && pixel.x() < camera.width - 2 &&
                          pixel.y() < camera.height - 2;
      if (!inside) continue;
      const double error_m = std::abs(Interpolate(b.depth_m, pixel) - x.z());
      if (error_m > kOccludedM) continue;
      result.depth_errors_m.push_back(error_m);
      result.gray_a.push_back(gray_a(v, u));
      result.gray_b.push_back(Interpolate(gray_b, pixel));
    }
  }
  return result;
}

TEST(SyntheticSequence, FramesAgreeInDepthAndColourWhereTheySeeTheSame) {
  for (const Motion motion : {Motion::kXyz, Motion::kRpy, Motion::kLoop}) {
    const SyntheticSequence sequence(Small(motion));
    for (int i = 0; i + 15 < sequence.size(); i += 97) {
      Covisible pixels = Compare(sequence.options().camera, sequence.Frame(i), sequence.Frame(i + 15));
      ASSERT_GT(pixels.depth_errors_m.size(), 320u * 240u / 9u / 3u);
      EXPECT_LT(pixels.MedianDepthErrorM(), 1e-3);
      EXPECT_GT(pixels.GrayCorrelation(), 0.95) << "frame " << i;
    }
  }
}

TEST(SyntheticSequence, EndOfTheLoopSeesItsStartAgain) {
  const SyntheticSequence sequence(Small(Motion::kLoop));
  const int round = static_cast<int>(sequence.size() / 1.1 + 0.5);
  Covisible pixels = Compare(sequence.options().camera, sequence.Frame(10), sequence.Frame(10 + round));
  EXPECT_GT(pixels.depth_errors_m.size(), 320u * 240u / 9u / 2u);
  EXPECT_GT(pixels.GrayCorrelation(), 0.95);
}

TEST(SyntheticSequence, MostViewsAreRichInCornersAndNoneIsBlank) {
  for (const Motion motion : {Motion::kXyz, Motion::kRpy, Motion::kLoop}) {
    SyntheticSequenceOptions options;
    options.motion = motion;
    const SyntheticSequence sequence(options);
    int views = 0, rich = 0;
    for (int i = 0; i < sequence.size(); i += 40, ++views) {
      std::vector<cv::KeyPoint> corners;
      cv::FAST(sequence.Frame(i).gray, corners, 20);
      rich += corners.size() >= 800;
      EXPECT_GT(corners.size(), 300u) << "frame " << i;
    }
    EXPECT_GE(rich, 0.9 * views);
  }
}

bool SamePixels(const SyntheticFrame& a, const SyntheticFrame& b) {
  return cv::norm(a.bgr, b.bgr, cv::NORM_INF) == 0 && cv::norm(a.gray, b.gray, cv::NORM_INF) == 0 &&
         cv::norm(a.depth_m, b.depth_m, cv::NORM_INF) == 0;
}

TEST(SyntheticSequence, FramesDependOnNeitherOrderNorThreads) {
  SyntheticSequenceOptions options = Small(Motion::kLoop);
  options.depth_noise = options.image_noise = true;
  const SyntheticSequence two_threads(options);
  options.num_threads = 5;
  const SyntheticSequence five_threads(options);
  const SyntheticFrame forwards[] = {two_threads.Frame(3), two_threads.Frame(200)};
  const SyntheticFrame backwards[] = {five_threads.Frame(200), five_threads.Frame(3)};
  EXPECT_TRUE(SamePixels(forwards[0], backwards[1]));
  EXPECT_TRUE(SamePixels(forwards[1], backwards[0]));
}

TEST(SyntheticSequence, SeedChangesThePaintAndEveryFrameHasItsOwnNoise) {
  SyntheticSequenceOptions options = Small(Motion::kStatic);
  const SyntheticSequence quiet(options);
  EXPECT_TRUE(SamePixels(quiet.Frame(0), quiet.Frame(1)));
  options.depth_noise = options.image_noise = true;
  const SyntheticSequence noisy(options);
  EXPECT_GT(cv::norm(noisy.Frame(0).depth_m, noisy.Frame(1).depth_m, cv::NORM_INF), 0);
  EXPECT_NEAR(cv::norm(noisy.Frame(0).gray, quiet.Frame(0).gray, cv::NORM_L2) / std::sqrt(320 * 240), 2.0,
              0.1);
  options.seed = 2;
  EXPECT_GT(
      cv::norm(SyntheticSequence(options).Frame(0).gray, noisy.Frame(0).gray, cv::NORM_L1) / (320 * 240), 5);
}

TEST(SyntheticSequenceOptions, RefusesWhatItCannotDo) {
  EXPECT_TRUE(SyntheticSequenceOptions().Check().ok());
  SyntheticSequenceOptions distorted, negative, threadless;
  distorted.camera.distortion[0] = 0.1;
  negative.num_frames = -1;
  threadless.num_threads = 0;
  for (const auto& options : {distorted, negative, threadless}) EXPECT_FALSE(options.Check().ok());
}

}  // namespace
}  // namespace orbslam
