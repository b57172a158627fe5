// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/synthetic_sequence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

enum Purpose : uint64_t {
  kDepthPurpose = 0x64657074,
  kColorPurpose = 0x696D6167,
  kClockPurpose = 0x636C6F63
};

std::unique_ptr<Renderer> MakeRenderer(const PinholeCamera& camera) {
  Result<std::unique_ptr<Renderer>> renderer = Renderer::Create(camera);
  ORBSLAM_CHECK(renderer.ok());
  return *std::move(renderer);
}

/// A slow random factor near 1.
double ExposureDrift(uint64_t seed, double time_s) {
  Rng rng(seed, 1, kColorPurpose);
  const double phase = rng.Uniform(0, 6.28), other_phase = rng.Uniform(0, 6.28);
  return 1 + 0.05 * std::sin(0.9 * time_s + phase) + 0.03 * std::sin(2.3 * time_s + other_phase);
}

}  // namespace

PinholeCamera SyntheticCamera(int width) {
  const double scale = width / 640.0;
  PinholeCamera camera;
  camera.width = width;
  camera.height = width * 3 / 4;
  camera.fx = 535.4 * scale;
  camera.fy = 539.2 * scale;
  camera.cx = (320.1 + 0.5) * scale - 0.5;  // pixel centres are whole numbers
  camera.cy = (247.6 + 0.5) * scale - 0.5;
  return camera;
}

Status SyntheticSequenceOptions::Check() const {
  constexpr int kMaxSide = 8192;
  if (num_frames < 0) return Error{"the number of frames must not be negative"};
  if (camera.width < 1 || camera.height < 1) return Error{"the camera's image is empty"};
  if (camera.width > kMaxSide || camera.height > kMaxSide) return Error{"the camera's image is too large"};
  if (!(camera.fx > 0 && camera.fy > 0)) return Error{"the camera's focal lengths must be positive"};
  if (camera.IsDistorted()) return Error{"a synthetic camera cannot be distorted"};
  if (!(texels_per_metre >= 16 && texels_per_metre <= 1024)) {
    return Error{"texels_per_metre must be between 16 and 1024"};
  }
  return OkStatus();
}

int SyntheticSequenceOptions::NumFrames() const {
  if (num_frames > 0) return num_frames;
  return static_cast<int>(std::lround(MotionDurationS(motion) * SyntheticSequence::kFramesPerSecond));
}

SyntheticSequence::SyntheticSequence(const SyntheticSequenceOptions& options)
    : options_(options),
      num_frames_(options.NumFrames()),
      path_(options.motion, options.seed),
      script_(options.script, options.seed, CameraView()) {
  ORBSLAM_CHECK(options.Check().ok());
  room_ = MakeRoom(options.seed, options.texels_per_metre);
  renderer_ = MakeRenderer(options.camera);
}

std::vector<SceneObject> SyntheticSequence::SceneAt(double time_s) const {
  std::vector<SceneObject> objects = script_.ObjectsAt(time_s);
  objects.insert(objects.end(), room_.objects.begin(), room_.objects.end());
  return objects;
}

SyntheticSequence::Clocks SyntheticSequence::ClocksOf(int index) const {
  const double time_s = index / kFramesPerSecond;
  if (!options_.sensor.separate_clocks) return {time_s, time_s};
  Rng rng(options_.seed, index, kClockPurpose);
  const double color_s = time_s + rng.Uniform(0, 0.002);
  return {color_s, time_s + 0.010 + rng.Uniform(-0.003, 0.006)};
}

Lighting SyntheticSequence::LightingAt(double time_s) const {
  Lighting lighting = room_.lighting;
  Rng rng(options_.seed, 2, kColorPurpose);
  const double off_s = rng.Uniform(2, 4), on_s = off_s + rng.Uniform(2, 4);
  if (!options_.sensor.light_switch || time_s < off_s || time_s > on_s) return lighting;
  for (size_t i = 0; i < lighting.lamps.size() / 2; ++i) lighting.lamps[i].power_bgr *= 0.02f;
  lighting.from_above_bgr *= 0.55f;
  lighting.from_below_bgr *= 0.55f;
  return lighting;
}

cv::Mat SyntheticSequence::Color(int index, double time_s) const {
  constexpr double kExposureS = 1.0 / 60;
  constexpr int kBlurSteps = 5;
  const int steps = options_.sensor.motion_blur ? kBlurSteps : 1;
  const Lighting lighting = LightingAt(time_s);
  cv::Mat sum;
  for (int i = 0; i < steps; ++i) {  // the exposure is centred on the time stamp
    const double at_s = time_s + kExposureS * ((i + 0.5) / steps - 0.5);
    const cv::Mat bgr = renderer_->RenderColor(SceneAt(at_s), lighting, path_.WorldFromCamera(at_s));
    if (steps == 1)
      sum = bgr;
    else if (sum.empty())
      bgr.convertTo(sum, CV_16U);
    else
      cv::add(sum, bgr, sum, cv::noArray(), CV_16U);
  }
  cv::Mat bgr;
  sum.convertTo(bgr, CV_8U, 1.0 / steps);
  Rng rng(options_.seed, index, kColorPurpose);
  DistortColor(options_.sensor, ExposureDrift(options_.seed, time_s), &rng, &bgr);
  return bgr;
}

SyntheticFrame SyntheticSequence::Frame(int index) const {
  ORBSLAM_CHECK(index >= 0 && index < num_frames_);
  const Clocks clocks = ClocksOf(index);
  SyntheticFrame frame;
  frame.timestamp_s = clocks.color_s;
  frame.depth_timestamp_s = clocks.depth_s;
  frame.world_from_camera = path_.WorldFromCamera(clocks.color_s);
  const cv::Size size(options_.camera.width, options_.camera.height);
  if (path_.IsCovered(clocks.color_s)) {
    frame.bgr = cv::Mat::zeros(size, CV_8UC3), frame.depth_m = cv::Mat::zeros(size, CV_32FC1);
    frame.gray = cv::Mat::zeros(size, CV_8UC1);
    frame.mask = frame.gray.clone(), frame.mask_moving = frame.gray.clone();
    return frame;
  }
  frame.bgr = Color(index, clocks.color_s);
  cv::cvtColor(frame.bgr, frame.gray, cv::COLOR_BGR2GRAY);
  GeometryView view = renderer_->RenderGeometry(SceneAt(clocks.color_s), frame.world_from_camera);
  frame.mask = view.labels > 0;
  frame.mask_moving = view.moving;
  if (clocks.depth_s != clocks.color_s) {
    view = renderer_->RenderGeometry(SceneAt(clocks.depth_s), path_.WorldFromCamera(clocks.depth_s));
  }
  Rng rng(options_.seed, index, kDepthPurpose);
  frame.depth_m = MeasureDepth(view, options_.camera, options_.sensor, &rng);
  return frame;
}

}  // namespace orbslam
