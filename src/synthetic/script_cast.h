// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "orbslam/synthetic/actor.h"
#include "orbslam/synthetic/props.h"
#include "orbslam/synthetic/script.h"
#include "orbslam/util/random.h"

namespace orbslam {

/// Who and what takes part in a script.
struct ScriptCast {
  struct Thing {
    Prop prop;
    uint8_t label = 0;
    std::function<Rigid3d(double time_s)> world_from_thing;
  };

  std::vector<std::shared_ptr<const Actor>> actors;
  std::vector<Thing> things;

  /// Always the same objects in the same order; is_moving is left false.
  std::vector<SceneObject> ObjectsAt(double time_s) const;
};

ScriptCast MakeCast(ScriptKind kind, uint64_t seed, const CameraView& view);

/// Places on the floor as the camera sees them: metres to the right of its line of sight and ahead of it,
/// moved to the free floor where they would lie outside. If there is less than kDepthM of free floor before
/// the camera, everything comes nearer by what is missing.
class Stage {
 public:
  static constexpr double kDepthM = 1.75;

  explicit Stage(const CameraView& view);

  Eigen::Vector2d At(double right, double ahead) const;
  /// The direction, as a heading, of something seen from a place; and of the camera.
  double Towards(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  double ToCamera(const Eigen::Vector2d& from) const { return Towards(from, camera_); }
  double heading() const { return heading_; }

 private:
  Eigen::Vector2d camera_, origin_;
  double heading_;
};

/// Writes a plan in the stage's words. side is 1 or -1 and turns right into left.
class Director {
 public:
  Director(const Stage& stage, const Figure& figure, double side, double right, double ahead, double speed,
           Rng* rng);

  Director& Wait(double least_s, double most_s);
  Director& Go(double right, double ahead);
  Director& Face();  // the camera
  Director& Back();  // to the first place and heading
  GaitPlan& plan() { return plan_; }
  GaitPlan Looped();

 private:
  const Stage& stage_;
  double side_, speed_;
  Rng* rng_;
  Placement first_;
  GaitPlan plan_;
};

/// What the scripts with things add to a cast.
void AddObjectsScript(const Stage& stage, uint64_t seed, ScriptCast* cast);
void AddStillThenAllScript(const Stage& stage, uint64_t seed, ScriptCast* cast);
void AddCoverScript(const Stage& stage, uint64_t seed, ScriptCast* cast);
void AddPutDownScript(const Stage& stage, uint64_t seed, ScriptCast* cast);
void AddTakenAwayScript(const Stage& stage, uint64_t seed, ScriptCast* cast);

/// A chair at a place on the floor for someone who is about to sit down, or sits.
ScriptCast::Thing ChairBehind(const Figure& figure, const Placement& body, uint64_t seed, uint8_t label);

}  // namespace orbslam
