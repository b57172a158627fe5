// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/synthetic_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <thread>

#include "orbslam/features/orb_extractor.h"
#include "orbslam/geometry/so3.h"

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
    for (int i = 0; i < sequence.size(); i += 80, ++views) {
      std::vector<cv::KeyPoint> corners;
      cv::FAST(sequence.Frame(i).gray, corners, 20);
      rich += corners.size() >= 800;
      EXPECT_GT(corners.size(), 200u) << "frame " << i;
    }
    EXPECT_GE(rich, 0.6 * views);
  }
}

bool SamePixels(const SyntheticFrame& a, const SyntheticFrame& b) {
  return cv::norm(a.bgr, b.bgr, cv::NORM_INF) == 0 && cv::norm(a.gray, b.gray, cv::NORM_INF) == 0 &&
         cv::norm(a.depth_m, b.depth_m, cv::NORM_INF) == 0 && cv::norm(a.mask, b.mask, cv::NORM_INF) == 0;
}

TEST(SyntheticSequence, FramesDependOnNeitherOrderNorThreads) {
  SyntheticSequenceOptions options = Small(Motion::kLoop);
  options.script = ScriptKind::kWalking;
  options.sensor = SensorEffects::Usual();
  const SyntheticSequence one(options), other(options);
  const SyntheticFrame forwards[] = {one.Frame(3), one.Frame(200)};
  SyntheticFrame backwards[2];
  {
    const std::jthread first([&] { backwards[1] = other.Frame(200); });
    const std::jthread second([&] { backwards[0] = other.Frame(3); });
  }
  EXPECT_TRUE(SamePixels(forwards[0], backwards[0]));
  EXPECT_TRUE(SamePixels(forwards[1], backwards[1]));
}

TEST(SyntheticSequence, SeedChangesThePaintAndEveryFrameHasItsOwnNoise) {
  SyntheticSequenceOptions options = Small(Motion::kStatic);
  const SyntheticFrame quiet = SyntheticSequence(options).Frame(0);
  options.sensor = {.depth_noise = true, .image_noise = true};
  const SyntheticSequence noisy(options);
  const double noise = cv::norm(noisy.Frame(0).bgr, quiet.bgr, cv::NORM_L2) / std::sqrt(3 * 320 * 240);
  EXPECT_GT(noise, 1.5);
  EXPECT_LT(noise, 4);
  EXPECT_GT(cv::norm(noisy.Frame(0).depth_m, quiet.depth_m, cv::NORM_INF), 0.005);
  options.seed = 2;
  EXPECT_GT(cv::norm(SyntheticSequence(options).Frame(0).gray, quiet.gray, cv::NORM_L1) / (320 * 240), 5);
}

/// Distances, px, from where Lucas-Kanade finds static corners of a in b to where ground truth puts them.
std::vector<double> FlowErrorsPx(const PinholeCamera& camera, const SyntheticFrame& a,
                                 const SyntheticFrame& b) {
  std::vector<cv::Point2f> corners, found;
  cv::goodFeaturesToTrack(a.gray, corners, 300, 0.01, 5, a.mask == 0);
  std::vector<uint8_t> ok;
  cv::calcOpticalFlowPyrLK(a.gray, b.gray, corners, found, ok, cv::noArray());
  const Rigid3d b_from_a = Inverse(b.world_from_camera) * a.world_from_camera;
  std::vector<double> errors;
  for (size_t k = 0; k < corners.size(); ++k) {
    const cv::Point2f corner = corners[k];
    const float depth_m = a.depth_m.at<float>(cv::Point(corner));
    if (!ok[k] || depth_m <= 0) continue;
    const Eigen::Vector2d expected = camera.Project(b_from_a * camera.Unproject(corner.x, corner.y, depth_m));
    errors.push_back((expected - Eigen::Vector2d(found[k].x, found[k].y)).norm());
  }
  return errors;
}

TEST(SyntheticSequence, OpticalFlowOfStaticPixelsIsThatOfTheGroundTruth) {
  for (const Motion motion : {Motion::kStatic, Motion::kXyz, Motion::kRpy, Motion::kHalfsphere}) {
    SyntheticSequenceOptions options = Small(motion);
    options.script = ScriptKind::kWalking;
    options.sensor.image_noise = true;
    const SyntheticSequence sequence(options);
    for (int i = 20; i + 1 < sequence.size(); i += 130) {
      auto errors = FlowErrorsPx(options.camera, sequence.Frame(i), sequence.Frame(i + 1));
      ASSERT_GT(errors.size(), 80u);
      std::ranges::nth_element(errors, errors.begin() + errors.size() / 2);
      EXPECT_LT(errors[errors.size() / 2], 0.3) << MotionName(motion) << ", frame " << i;
    }
  }
}

/// Mean squared difference of pixels beside each other.
double SharpnessOf(const cv::Mat& gray) {
  const cv::Mat_<float> image = gray;
  const cv::Mat step = image.colRange(1, image.cols) - image.colRange(0, image.cols - 1);
  return step.dot(step) / static_cast<double>(step.total());
}

TEST(SyntheticSequence, MotionBlurSmearsTheColourOfACameraThatTurnsAndNothingElse) {
  SyntheticSequenceOptions options = Small(Motion::kRpy);
  const SyntheticSequence sharp(options);
  options.sensor.motion_blur = true;
  const SyntheticSequence blurred(options);
  double slowest = 1, fastest = 0, least = 1, most = 0;  // radians a frame; shares of the sharpness left
  for (int i = 0; i < 60; i += 4) {
    const SyntheticFrame a = sharp.Frame(i), b = blurred.Frame(i);
    EXPECT_EQ(cv::norm(a.depth_m, b.depth_m, cv::NORM_INF), 0);
    EXPECT_NEAR(cv::mean(a.gray)[0], cv::mean(b.gray)[0], 1);
    const double left = SharpnessOf(b.gray) / SharpnessOf(a.gray);
    const double turn =
        AngularDistance(a.world_from_camera.rotation, sharp.Frame(i + 1).world_from_camera.rotation);
    if (turn < slowest) slowest = turn, most = left;
    if (turn > fastest) fastest = turn, least = left;
  }
  EXPECT_LT(least, 0.9);
  EXPECT_GT(most, least + 0.05);
}

TEST(SyntheticSequence, MasksAreTheDepthsThatPeopleChange) {
  SyntheticSequenceOptions options = Small(Motion::kStatic);
  const SyntheticSequence empty(options);
  options.script = ScriptKind::kWalking;
  const SyntheticSequence sequence(options);
  double most = 0;
  for (int i = 0; i < sequence.size(); i += 60) {
    const SyntheticFrame with = sequence.Frame(i), without = empty.Frame(i);
    const cv::Mat differs = cv::abs(with.depth_m - without.depth_m) > 1e-4;
    EXPECT_LE(cv::countNonZero(differs != with.mask), 8) << "soles that touch the floor; frame " << i;
    EXPECT_EQ(cv::countNonZero(with.mask_moving & ~with.mask), 0);
    EXPECT_EQ(cv::countNonZero(without.mask), 0);
    most = std::max(most, cv::countNonZero(with.mask) / (320.0 * 240.0));
  }
  EXPECT_GT(most, 0.05);
}

TEST(SyntheticSequence, ExtractorFindsItsThousandCornersSpreadOverTheImage) {
  SyntheticSequenceOptions options;
  options.sensor = SensorEffects::Usual();
  OrbExtractor extractor{OrbExtractorOptions()};
  const OrbFeatures features = extractor.Extract(SyntheticSequence(options).Frame(0).gray);
  EXPECT_GE(features.keypoints.size(), 1000u);
  cv::Mat count = cv::Mat::zeros(3, 4, CV_32S);
  for (const OrbKeypoint& k : features.keypoints)
    ++count.at<int>(static_cast<int>(k.v / 160), static_cast<int>(k.u / 160));
  EXPECT_GE(cv::countNonZero(count >= 15), 11) << count;
}

TEST(SyntheticSequence, ClocksOfColourAndDepthAreApartIfWanted) {
  SyntheticSequenceOptions options = Small(Motion::kXyz);
  const SyntheticFrame together = SyntheticSequence(options).Frame(40);
  EXPECT_EQ(together.timestamp_s, together.depth_timestamp_s);
  options.sensor.separate_clocks = true;
  const SyntheticSequence apart(options);
  double last_s = -1;
  for (int i = 40; i < 44; ++i) {
    const SyntheticFrame frame = apart.Frame(i);
    EXPECT_NEAR(frame.depth_timestamp_s - frame.timestamp_s, 0.010, 0.009);
    EXPECT_GT(frame.timestamp_s, last_s);
    last_s = frame.timestamp_s;
  }
}

TEST(SyntheticSequence, CoveredCameraSeesNothing) {
  const SyntheticSequence sequence(Small(Motion::kKidnap));
  const SyntheticFrame covered = sequence.Frame(static_cast<int>(23 * SyntheticSequence::kFramesPerSecond));
  EXPECT_EQ(cv::countNonZero(covered.gray) + cv::countNonZero(covered.depth_m), 0);
}

TEST(SyntheticSequenceOptions, RefusesWhatItCannotDo) {
  EXPECT_TRUE(SyntheticSequenceOptions().Check().ok());
  SyntheticSequenceOptions distorted, negative, coarse;
  distorted.camera.distortion[0] = 0.1;
  negative.num_frames = -1;
  coarse.texels_per_metre = 1;
  for (const auto& options : {distorted, negative, coarse}) EXPECT_FALSE(options.Check().ok());
}

/// Nobody could track a camera that sees nothing of the room.
TEST(SyntheticSequence, WhoeverFillsThePictureLeavesAPartOfTheRoomToSee) {
  for (const ScriptKind script : {ScriptKind::kClose, ScriptKind::kCover}) {
    const SyntheticSequence sequence({.motion = Motion::kXyz,
                                      .script = script,
                                      .num_frames = 300,
                                      .camera = SyntheticCamera(160),
                                      .texels_per_metre = 64});
    double most = 0;
    for (int i = 0; i < sequence.size(); i += 3) {
      const cv::Mat mask = sequence.Frame(i).mask;
      most = std::max(most, cv::countNonZero(mask) / static_cast<double>(mask.total()));
    }
    EXPECT_GT(most, 0.75) << ScriptName(script);
    EXPECT_LT(most, 0.95) << ScriptName(script);
  }
}

}  // namespace
}  // namespace orbslam
