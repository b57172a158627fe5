// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/script.h"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <utility>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

constexpr std::array<std::pair<ScriptKind, std::string_view>, 13> kNames = {{
    {ScriptKind::kStatic, "static"},
    {ScriptKind::kWalking, "walking"},
    {ScriptKind::kSitting, "sitting"},
    {ScriptKind::kObjects, "objects"},
    {ScriptKind::kClose, "close"},
    {ScriptKind::kStillThenAll, "still_then_all"},
    {ScriptKind::kCover, "cover"},
    {ScriptKind::kCrossing, "crossing"},
    {ScriptKind::kWaiting, "waiting"},
    {ScriptKind::kNewlySeen, "newly_seen"},
    {ScriptKind::kPutDown, "put_down"},
    {ScriptKind::kTakenAway, "taken_away"},
    {ScriptKind::kMonitor, "monitor"},
}};

constexpr auto kKinds = [] {
  std::array<ScriptKind, kNames.size()> kinds{};
  for (size_t i = 0; i < kNames.size(); ++i) kinds[i] = kNames[i].first;
  return kinds;
}();

Mesh CapsuleMan() {
  constexpr int kAround = 24, kAlong = 24;
  constexpr double kRadius = 0.24, kHeight = 1.75, kTurn = 2 * std::numbers::pi;
  Mesh mesh;
  for (int j = 0; j <= kAlong; ++j) {
    const double polar = std::numbers::pi * j / kAlong;
    const double middle = j <= kAlong / 2 ? kRadius : kHeight - kRadius;
    for (int i = 0; i <= kAround; ++i) {
      const double angle = kTurn * i / kAround;
      const Eigen::Vector3d normal(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                                   -std::cos(polar));
      const Eigen::Vector3d position = kRadius * normal + middle * Eigen::Vector3d::UnitZ();
      mesh.vertices.push_back(
          {position.cast<float>(), normal.cast<float>(),
           Eigen::Vector2f(5.0f * static_cast<float>(i) / kAround, static_cast<float>(position.z() * 3.0))});
    }
  }
  for (uint32_t j = 0; j < kAlong; ++j) {
    for (uint32_t i = 0; i < kAround; ++i) {
      const uint32_t a = j * (kAround + 1) + i, b = a + 1, c = a + kAround + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

}  // namespace

std::optional<ScriptKind> ParseScript(std::string_view name) {
  for (const auto& [kind, known] : kNames) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

std::string_view ScriptName(ScriptKind kind) { return kNames[static_cast<size_t>(kind)].second; }

std::span<const ScriptKind> AllScripts() { return kKinds; }

struct Script::Cast {
  ScriptKind kind;
  CameraView view;
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const cv::Mat> texture;
};

Script::~Script() = default;
Script::Script(const Script&) = default;
Script& Script::operator=(const Script&) = default;

Script::Script(ScriptKind kind, uint64_t seed, const CameraView& view) {
  Rng rng(seed);
  cv::Mat cloth(128, 128, CV_8UC3);
  for (auto& pixel : cv::Mat_<cv::Vec3b>(cloth)) {
    pixel = cv::Vec3b::all(static_cast<uint8_t>(rng.Below(256)));
  }
  cast_ = std::make_shared<const Cast>(
      Cast{kind, view, std::make_shared<const Mesh>(CapsuleMan()), std::make_shared<const cv::Mat>(cloth)});
}

std::vector<SceneObject> Script::ObjectsAt(double time_s) const {
  if (cast_->kind == ScriptKind::kStatic) return {};
  SceneObject man{cast_->mesh, {cast_->texture}, {}, kFirstPersonLabel, true};
  man.world_from_mesh.translation = {std::sin(0.6 * time_s), cast_->view.position.y() + 1.2, 0};
  return {man};
}

}  // namespace orbslam
