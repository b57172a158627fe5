// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "orbslam/render/scene.h"

namespace orbslam {

/// What happens in the room. Times are seconds from the start of the sequence.
enum class ScriptKind {
  kStatic,        // nobody
  kWalking,       // two people walk to and fro before the camera, stop, turn, come close, leave the view
  kSitting,       // two people sit on chairs and gesture
  kObjects,       // a box is carried, a chair pushed, a door opened
  kClose,         // someone comes nearer than 0.45 m, where depth ends, fills the picture, goes away
  kStillThenAll,  // two people stand and a chair too for 10 s, then all of them move
  kCover,         // a panel is carried before the camera: it covers four fifths of the picture
  kCrossing,      // two people cross, again and again
  kWaiting,       // someone stands for 5 s, then walks
  kNewlySeen,     // someone stands beside the picture (seen once the camera turns), later walks through it
  kPutDown,       // someone brings a box, puts it down and leaves; the box stays
  kTakenAway,     // someone comes, takes a box that has stood there, and leaves with it
  kMonitor,       // someone walks close before the desk with its monitors (surfaces without depth)
  kCrowd,         // four people walk, cross, stand for seconds, and hide up to half of the room
};

/// "static", "walking", "sitting", "objects", "close", "still_then_all", "cover", "crossing", "waiting",
/// "newly_seen", "put_down", "taken_away", "monitor", "crowd".
std::optional<ScriptKind> ParseScript(std::string_view name);
std::string_view ScriptName(ScriptKind kind);
std::span<const ScriptKind> AllScripts();

struct ScriptCast;

/// Where the camera is in the mean and what it looks at: world frame, metres, z up, the floor at z = 0.
struct CameraView {
  Eigen::Vector3d position{0.0, -0.4, 1.4}, target{0.0, 2.1, 0.9};
};

/// People and things that move through the room of MakeRoom, played to a camera. People keep to the free
/// floor, |x| < kFreeX, |y| < kFreeY, at least kMinDistanceM from the camera's mean place (kClose: kCloseM),
/// and pass each other at 0.4 m or more (middle to middle). Everything is a pure function of (kind, seed,
/// view, time): the seed varies clothes, heights, speeds, places and pauses.
class Script {
 public:
  static constexpr double kFreeX = 1.9, kFreeY = 1.4;  // metres
  static constexpr double kMinDistanceM = 0.8, kCloseM = 0.48;
  static constexpr double kMovingSpeed = 0.02;  // m/s
  static constexpr double kMovingWindowS = 1.0 / 30;
  static constexpr uint8_t kFirstPersonLabel = 1, kFirstThingLabel = 11;

  Script(ScriptKind kind, uint64_t seed, const CameraView& view);

  /// Everything that can move, with a label of its own per person or thing; a person's parts share one. A
  /// part is_moving if its fastest vertex went further than kMovingSpeed * kMovingWindowS during the last
  /// kMovingWindowS. Any time, also a negative one.
  std::vector<SceneObject> ObjectsAt(double time_s) const;

 private:
  std::shared_ptr<const ScriptCast> cast_;
};

}  // namespace orbslam
