// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "noise.h"
#include "normal_table.h"
#include "orbslam/camera/depth_model.h"
#include "orbslam/synthetic/sensor.h"

namespace orbslam {
namespace {

constexpr double kBaselineM = 0.075;  // from the projector to the infrared camera
constexpr double kSensorFx = 535.4;   // px, in which disparity is measured, whatever the size of the picture

float JumpLimitM(float depth_m) { return 0.03f + 0.02f * depth_m; }

/// Takes each depth from a place up to two pixels away, so that silhouettes become ragged, and drops pixels
/// beside which the depth jumps.
void RoughenEdges(Rng* rng, cv::Mat* depth_m) {
  constexpr float kReachPx = 0.8f;
  const cv::Size size = depth_m->size();
  const cv::Mat shift_x = FractalNoise(size, 8, 0.0, rng), shift_y = FractalNoise(size, 8, 0.0, rng);
  cv::Mat low, high, result = depth_m->clone();
  const cv::Mat square = cv::Mat::ones(3, 3, CV_8U);
  cv::erode(*depth_m, low, square);
  cv::dilate(*depth_m, high, square);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const float nearest = low.at<float>(v, u);
      if (high.at<float>(v, u) - nearest < JumpLimitM(nearest)) continue;
      const int from_u = std::clamp(u + static_cast<int>(std::lround(kReachPx * shift_x.at<float>(v, u))), 0,
                                    size.width - 1);
      const int from_v = std::clamp(v + static_cast<int>(std::lround(kReachPx * shift_y.at<float>(v, u))), 0,
                                    size.height - 1);
      const bool is_hole = shift_x.at<float>(v, u) * shift_y.at<float>(v, u) > 0.1f;
      result.at<float>(v, u) = is_hole ? 0.0f : depth_m->at<float>(from_v, from_u);
    }
  }
  *depth_m = result;
}

/// What comes back of the projector's dots: weak from dark surfaces, at grazing angles and from afar.
void DropAbsorbed(const GeometryView& view, Rng* rng, cv::Mat* depth_m) {
  constexpr float kLeast = 0.022f, kPatchiness = 0.35f;
  const cv::Mat patches = FractalNoise(depth_m->size(), 16, 0.0, rng);
  for (int v = 0; v < depth_m->rows; ++v) {
    for (int u = 0; u < depth_m->cols; ++u) {
      const float infrared = static_cast<float>(view.infrared.at<uint8_t>(v, u)) / 255.0f;
      const float cosine = static_cast<float>(view.cosine.at<uint8_t>(v, u)) / 255.0f;
      const float z = std::max(1.0f, depth_m->at<float>(v, u));
      const float back = infrared * cosine / z * (1 + kPatchiness * patches.at<float>(v, u));
      if (back < kLeast) depth_m->at<float>(v, u) = 0;
    }
  }
}

/// The projector is beside the camera, on its right: there the background left of near things is hidden from
/// it. Along a row, what it sees has ascending columns in its own picture.
void DropShadow(double fx, cv::Mat* depth_m) {
  constexpr float kTolerancePx = 1.0f;
  const auto base = static_cast<float>(fx * kBaselineM);
  for (int v = 0; v < depth_m->rows; ++v) {
    auto* row = depth_m->ptr<float>(v);
    float least = 1e9f;
    for (int u = depth_m->cols - 1; u >= 0; --u) {
      if (row[u] <= 0) continue;
      const float seen_at = static_cast<float>(u) - base / row[u];
      if (seen_at > least + kTolerancePx) row[u] = 0;
      least = std::min(least, seen_at);
    }
  }
}

void AddNoise(Rng* rng, cv::Mat* depth_m) {
  constexpr float kStepsPerPx = 8;
  constexpr auto kBase = static_cast<float>(kSensorFx * kBaselineM) * kStepsPerPx;
  NormalStream normal(rng);
  for (float& depth : cv::Mat_<float>(*depth_m)) {
    const float measured = depth + normal.Next() * static_cast<float>(DepthModel::SigmaM(depth));
    if (depth > 0) depth = measured > 0 ? kBase / std::max(1.0f, std::nearbyint(kBase / measured)) : 0.0f;
  }
}

void LimitRange(cv::Mat* depth_m) {
  constexpr float kMinM = 0.5f, kMaxM = 8.0f;
  for (float& depth : cv::Mat_<float>(*depth_m)) {
    if (depth < kMinM || depth > kMaxM) depth = 0;
  }
}

}  // namespace

SensorEffects SensorEffects::Usual() {
  SensorEffects effects;
  effects.depth_noise = effects.depth_range = effects.depth_edges = effects.depth_absorption = true;
  effects.projector_shadow = effects.image_noise = effects.image_blur = effects.exposure = true;
  effects.separate_clocks = true;
  return effects;
}

cv::Mat MeasureDepth(const GeometryView& view, const PinholeCamera& camera, const SensorEffects& effects,
                     Rng* rng) {
  cv::Mat depth_m = view.depth_m.clone();
  if (effects.depth_range) LimitRange(&depth_m);  // what is too near casts no measurable shadow either
  if (effects.depth_absorption) DropAbsorbed(view, rng, &depth_m);
  if (effects.projector_shadow) DropShadow(camera.fx, &depth_m);
  if (effects.depth_edges) RoughenEdges(rng, &depth_m);
  if (effects.depth_noise) AddNoise(rng, &depth_m);
  return depth_m;
}

}  // namespace orbslam
