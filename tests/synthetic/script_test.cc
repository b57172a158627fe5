// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/script.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace orbslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kEndS = 40, kTickS = 0.25;
const CameraView kView;

bool IsPerson(uint8_t label) {
  return label >= Script::kFirstPersonLabel && label < Script::kFirstThingLabel;
}

Vector3d VertexAt(const SceneObject& object, size_t i) {
  return object.world_from_mesh * Vector3d(object.mesh->vertices[i].position.cast<double>());
}

/// The hips of everybody, which are the first part of each.
std::map<uint8_t, Vector3d> Hips(const std::vector<SceneObject>& objects) {
  std::map<uint8_t, Vector3d> hips;
  for (const SceneObject& object : objects) {
    if (IsPerson(object.label)) hips.try_emplace(object.label, object.world_from_mesh.translation);
  }
  return hips;
}

bool AnyMoves(const std::vector<SceneObject>& objects) {
  return std::any_of(objects.begin(), objects.end(), [](const SceneObject& o) { return o.is_moving; });
}

class ScriptOf : public testing::TestWithParam<std::tuple<ScriptKind, uint64_t>> {
 protected:
  /// Made once for all tests: painting clothes takes longer than moving people.
  static const Script& Made(const ParamType& param) {
    static std::map<ParamType, Script> made;
    return made.try_emplace(param, std::get<0>(param), std::get<1>(param), kView).first->second;
  }

  ScriptKind kind_ = std::get<0>(GetParam());
  const Script& script_ = Made(GetParam());
};

TEST_P(ScriptOf, SomethingMovesAtSomeTimeUnlessNobodyIsThere) {
  bool moves = false;
  for (double t = 0; t < kEndS && !moves; t += kTickS) moves = AnyMoves(script_.ObjectsAt(t));
  EXPECT_EQ(moves, kind_ != ScriptKind::kStatic);
}

TEST_P(ScriptOf, MovingIsWhatTheFastestVertexSays) {
  constexpr double kFar = Script::kMovingSpeed * Script::kMovingWindowS;
  for (const double t : {0.4, 3.1, 7.7, 12.9}) {
    const auto now = script_.ObjectsAt(t), before = script_.ObjectsAt(t - Script::kMovingWindowS);
    ASSERT_EQ(now.size(), before.size());
    for (size_t i = 0; i < now.size(); ++i) {
      double farthest = 0;
      for (size_t k = 0; k < now[i].mesh->vertices.size(); ++k) {
        farthest = std::max(farthest, (VertexAt(now[i], k) - VertexAt(before[i], k)).norm());
      }
      EXPECT_EQ(now[i].is_moving, farthest > kFar) << "part " << i << " at " << t << ": " << farthest;
    }
  }
}

TEST_P(ScriptOf, WhatCannotMoveDoesNot) {
  for (double t = 0; t < kEndS; t += 1) {
    for (const SceneObject& object : script_.ObjectsAt(t))
      EXPECT_FALSE(object.label == 0 && object.is_moving);
  }
}

TEST_P(ScriptOf, PeopleKeepToTheFreeFloorAndOffEachOtherAndTheCamera) {
  const double least = kind_ == ScriptKind::kClose ? Script::kCloseM : Script::kMinDistanceM;
  for (double t = 0; t < kEndS; t += 0.1) {
    const auto hips = Hips(script_.ObjectsAt(t));
    for (const auto& [label, place] : hips) {
      // Hips sway, and who sits has his feet on the free floor.
      EXPECT_LT(std::abs(place.x()), Script::kFreeX + 0.05) << "at " << t;
      EXPECT_LT(std::abs(place.y()), Script::kFreeY + (place.z() < 0.7 ? 0.4 : 0.05)) << "at " << t;
      EXPECT_GT((place - kView.position).head<2>().norm(), least - 0.03) << "at " << t;
    }
    for (auto one = hips.begin(); one != hips.end(); ++one)
      for (auto other = std::next(one); other != hips.end(); ++other)
        EXPECT_GT((one->second - other->second).head<2>().norm(), 0.4) << "at " << t;
  }
}

TEST_P(ScriptOf, ATimeShowsTheSameWheneverItIsAsked) {
  const Script again(kind_, std::get<1>(GetParam()), kView);
  again.ObjectsAt(20);
  for (const double t : {9.3, 2.2, -1.0}) {
    const auto a = script_.ObjectsAt(t), b = again.ObjectsAt(t);
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].world_from_mesh.translation, b[i].world_from_mesh.translation);
      EXPECT_EQ(a[i].world_from_mesh.rotation.coeffs(), b[i].world_from_mesh.rotation.coeffs());
      EXPECT_EQ(a[i].is_moving, b[i].is_moving);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ScriptOf,
                         testing::Combine(testing::ValuesIn(AllScripts().begin(), AllScripts().end()),
                                          testing::Values(1, 2)),
                         [](const auto& test) {
                           return std::string(ScriptName(std::get<0>(test.param))) + "_" +
                                  std::to_string(std::get<1>(test.param));
                         });

TEST(Script, NamesAreReadBack) {
  for (const ScriptKind kind : AllScripts()) EXPECT_EQ(ParseScript(ScriptName(kind)), kind);
  EXPECT_EQ(ParseScript("dancing"), std::nullopt);
}

TEST(Script, NobodyMovesForTenSecondsThenAll) {
  const Script script(ScriptKind::kStillThenAll, 3, kView);
  for (double t = 0; t < 9.8; t += kTickS) EXPECT_FALSE(AnyMoves(script.ObjectsAt(t))) << "at " << t;
  std::set<uint8_t> labels, moving;
  for (const SceneObject& object : script.ObjectsAt(11.5)) {
    labels.insert(object.label);
    if (object.is_moving) moving.insert(object.label);
  }
  EXPECT_EQ(labels, moving);
}

TEST(Script, WhatIsPutDownStaysAndWhatIsTakenWasThere) {
  const auto carton_moves = [](const Script& script, double time_s) {
    for (const SceneObject& object : script.ObjectsAt(time_s)) {
      if (object.label == Script::kFirstThingLabel) return object.is_moving;
    }
    return false;
  };
  const Script put_down(ScriptKind::kPutDown, 1, kView), taken(ScriptKind::kTakenAway, 1, kView);
  EXPECT_TRUE(carton_moves(put_down, 2.0));
  EXPECT_FALSE(carton_moves(taken, 2.0));
  bool moved = false;
  for (double t = 2; t < 15; t += 0.1) moved = moved || carton_moves(taken, t);
  EXPECT_TRUE(moved);
  for (double t = 12; t < 30; t += kTickS) EXPECT_FALSE(carton_moves(put_down, t)) << "at " << t;
}

TEST(Script, SomeoneWaitsFiveSecondsThenWalks) {
  const Script script(ScriptKind::kWaiting, 4, kView);
  for (double t = 0; t < 4.8; t += kTickS) EXPECT_FALSE(AnyMoves(script.ObjectsAt(t))) << "at " << t;
  EXPECT_TRUE(AnyMoves(script.ObjectsAt(6.5)));
}

}  // namespace
}  // namespace orbslam
