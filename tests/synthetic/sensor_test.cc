// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "orbslam/camera/depth_model.h"
#include "orbslam/synthetic/synthetic_sequence.h"

namespace orbslam {
namespace {

/// A wall straight before the camera, bright to the projector.
GeometryView Wall(float depth_m) {
  const cv::Size size(320, 240);
  return {cv::Mat(size, CV_32FC1, cv::Scalar(depth_m)), cv::Mat::zeros(size, CV_8U),
          cv::Mat::zeros(size, CV_8U), cv::Mat(size, CV_8U, cv::Scalar(255)),
          cv::Mat(size, CV_8U, cv::Scalar(255))};
}

/// With a board before its right half.
GeometryView WallAndBoard(float board_m, float wall_m) {
  GeometryView view = Wall(wall_m);
  view.depth_m(cv::Rect(160, 0, 160, 240)).setTo(board_m);
  return view;
}

cv::Mat Measure(const GeometryView& view, const SensorEffects& effects) {
  Rng rng(3);
  return MeasureDepth(view, SyntheticCamera(320), effects, &rng);
}

int NumLost(const cv::Mat& depth_m) { return static_cast<int>(depth_m.total()) - cv::countNonZero(depth_m); }

TEST(MeasureDepth, WithoutEffectsIsExact) {
  const GeometryView view = WallAndBoard(0.3f, 9);
  EXPECT_EQ(cv::norm(Measure(view, {}), view.depth_m, cv::NORM_INF), 0);
}

TEST(MeasureDepth, NoiseHasTheModelsSigmaWithTheStepsOfDisparityAndNoBias) {
  for (const float depth_m : {0.6f, 1.0f, 2.0f, 4.0f}) {
    const cv::Mat measured = Measure(Wall(depth_m), {.depth_noise = true});
    const double base = SyntheticCamera(640).fx * 0.075 * 8, step_m = depth_m * depth_m / base;
    const double expected = std::hypot(DepthModel::SigmaM(depth_m), step_m / std::sqrt(12.0));
    cv::Mat mean, sigma;
    cv::meanStdDev(measured, mean, sigma);
    EXPECT_NEAR(sigma.at<double>(0), expected, 0.25 * expected + 0.3 * step_m);
    EXPECT_NEAR(mean.at<double>(0), depth_m, 0.3 * step_m + 0.1 * expected);
    for (int i = 0; i < 50; ++i) {
      const double steps = base / measured.at<float>(i, 2 * i);
      EXPECT_NEAR(steps, std::round(steps), 1e-3);
    }
  }
}

TEST(MeasureDepth, RangeEndsAtHalfAMetreAndAtEight) {
  for (const float depth_m : {0.2f, 0.45f, 8.1f})
    EXPECT_EQ(cv::countNonZero(Measure(Wall(depth_m), {.depth_range = true})), 0);
  for (const float depth_m : {0.51f, 7.9f})
    EXPECT_EQ(NumLost(Measure(Wall(depth_m), {.depth_range = true})), 0);
}

TEST(MeasureDepth, DarkAndGrazingSurfacesAreLost) {
  const SensorEffects effects{.depth_absorption = true};
  GeometryView dark = Wall(2), grazing = Wall(2);
  dark.infrared.setTo(5), grazing.cosine.setTo(5);
  EXPECT_LT(NumLost(Measure(Wall(2), effects)), 320 * 240 / 100);
  for (const GeometryView& view : {dark, grazing})
    EXPECT_GT(NumLost(Measure(view, effects)), 320 * 240 * 9 / 10);
}

TEST(MeasureDepth, ShadowIsLeftOfNearThingsAndAsWideAsTheParallax) {
  const cv::Mat measured = Measure(WallAndBoard(1, 3), {.projector_shadow = true});
  const double parallax_px = SyntheticCamera(320).fx * 0.075 * (1.0 - 1.0 / 3.0);
  EXPECT_NEAR(NumLost(measured) / 240.0, parallax_px, 2);
  EXPECT_EQ(measured.at<float>(100, 158), 0);
  EXPECT_EQ(cv::countNonZero(measured(cv::Rect(160, 0, 160, 240))), 160 * 240);
  EXPECT_EQ(NumLost(Measure(Wall(2), {.projector_shadow = true})), 0);
}

TEST(MeasureDepth, SilhouettesAreRaggedAndHaveHolesAndNothingElseHas) {
  const GeometryView view = WallAndBoard(1, 3);
  const cv::Mat measured = Measure(view, {.depth_edges = true});
  EXPECT_GT(NumLost(measured), 20);
  const cv::Mat changed = measured != view.depth_m;
  EXPECT_EQ(cv::countNonZero(changed(cv::Rect(0, 0, 155, 240))), 0);
  EXPECT_EQ(cv::countNonZero(changed(cv::Rect(165, 0, 155, 240))), 0);
}

TEST(DistortColor, EachSwitchDoesWhatItSays) {
  cv::Mat gray(200, 200, CV_8UC3, cv::Scalar::all(60)), mean, sigma;
  const auto distort = [&](const SensorEffects& effects, double drift) {
    Rng rng(1);
    cv::Mat image = gray.clone();
    DistortColor(effects, drift, &rng, &image);
    cv::meanStdDev(image, mean, sigma);
  };
  distort({}, 1.3);
  EXPECT_EQ(mean.at<double>(0), 60);
  distort({.image_noise = true}, 1.3);
  EXPECT_NEAR(mean.at<double>(0), 60, 0.3);
  EXPECT_NEAR(sigma.at<double>(1), 2.3, 0.4);
  distort({.exposure = true}, 1);
  EXPECT_GT(mean.at<double>(0), 70);  // dark: brightened
  const double before = mean.at<double>(0);
  distort({.exposure = true}, 1.1);
  EXPECT_GT(mean.at<double>(0), before);
  gray(cv::Rect(0, 0, 100, 200)).setTo(cv::Scalar::all(160));
  distort({}, 1);
  const double sharp = sigma.at<double>(0);
  distort({.image_blur = true}, 1);
  EXPECT_LT(sigma.at<double>(0), sharp);
}

TEST(LightSwitch, GoesOffAndOnAgain) {
  SyntheticSequenceOptions options;
  options.motion = Motion::kStatic, options.camera = SyntheticCamera(80), options.texels_per_metre = 32;
  options.sensor.light_switch = true;
  const SyntheticSequence sequence(options);
  const auto brightness = [&](int frame) { return cv::mean(sequence.Frame(frame).gray)[0]; };
  double least = 255;
  for (int i = 0; i < 260; i += 15) least = std::min(least, brightness(i));
  EXPECT_LT(least, 0.8 * brightness(0));
  EXPECT_NEAR(brightness(270), brightness(0), 3);
}

}  // namespace
}  // namespace orbslam
