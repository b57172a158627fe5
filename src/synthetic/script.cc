// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/script.h"

#include <array>
#include <utility>

#include "orbslam/util/check.h"
#include "script_cast.h"

namespace orbslam {
namespace {

constexpr std::array<std::pair<ScriptKind, std::string_view>, 14> kNames = {{
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
    {ScriptKind::kCrowd, "crowd"},
}};

constexpr auto kKinds = [] {
  std::array<ScriptKind, kNames.size()> kinds{};
  for (size_t i = 0; i < kNames.size(); ++i) kinds[i] = kNames[i].first;
  return kinds;
}();

/// Whether a vertex went further between two moments than kMovingSpeed allows.
bool Moves(const SceneObject& now, const SceneObject& before) {
  constexpr double kFar = Script::kMovingSpeed * Script::kMovingWindowS;
  const Eigen::Matrix3d turn = now.world_from_mesh.RotationMatrix() - before.world_from_mesh.RotationMatrix();
  const Eigen::Vector3d shift = now.world_from_mesh.translation - before.world_from_mesh.translation;
  for (const Vertex& vertex : now.mesh->vertices) {
    if ((turn * vertex.position.cast<double>() + shift).squaredNorm() > kFar * kFar) return true;
  }
  return false;
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

Script::Script(ScriptKind kind, uint64_t seed, const CameraView& view)
    : cast_(std::make_shared<const ScriptCast>(MakeCast(kind, seed, view))) {}

std::vector<SceneObject> Script::ObjectsAt(double time_s) const {
  std::vector<SceneObject> objects = cast_->ObjectsAt(time_s);
  const std::vector<SceneObject> before = cast_->ObjectsAt(time_s - kMovingWindowS);
  ORBSLAM_CHECK(objects.size() == before.size());
  for (size_t i = 0; i < objects.size(); ++i) objects[i].is_moving = Moves(objects[i], before[i]);
  return objects;
}

}  // namespace orbslam
