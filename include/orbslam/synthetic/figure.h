// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "orbslam/geometry/rigid3.h"
#include "orbslam/render/scene.h"
#include "orbslam/synthetic/gait.h"

namespace orbslam {

/// The rigid parts of a body. Each has its frame in the joint that hangs it to its parent; standing upright
/// all have x ahead, y to the left, z up. Odd offsets from a left part are its right twin.
enum BodyPart {
  kPelvis,  // frame: midway between the hip joints
  kTorso,   // frame: the waist
  kHead,    // frame: the foot of the neck
  kUpperArmLeft,
  kUpperArmRight,
  kForearmLeft,
  kForearmRight,
  kHandLeft,
  kHandRight,
  kThighLeft,
  kThighRight,
  kShinLeft,
  kShinRight,
  kFootLeft,
  kFootRight,
  kToesLeft,
  kToesRight,
  kNumBodyParts
};

/// Lengths in metres as shares of the height (Drillis and Contini, 1966).
struct BodySize {
  explicit BodySize(double height_m);

  double height, thigh, shin, half_hips, half_stance, waist, shoulder_height, half_shoulders, neck_height;
  double upper_arm, forearm, hand;  // waist is above the hips, shoulder and neck above the waist
  FootShape foot;
};

/// Where a child hangs on its parent: the joint in the parent's frame (it is the child's origin).
struct BodyJoint {
  BodyPart parent, child;
  Eigen::Vector3d in_parent;
};
std::vector<BodyJoint> BodyJoints(const BodySize& size);

/// An arm by its angles, radians: flexion lifts it forwards, abduction sideways, turn brings the bent forearm
/// inwards; or, where hand is set, by the place of the wrist (world frame, metres) that it reaches for as
/// far as it can.
struct ArmControl {
  double flexion = 0, abduction = 0.12, turn = 0.1, elbow = 0.25;
  std::optional<Eigen::Vector3d> wrist;
  double wrist_weight = 1;  // 0: angles, 1: wrist; in between, a point between
};

/// What the body does above the hips. Radians; yaw to the left, pitch forwards and down.
struct UpperBody {
  double pelvis_yaw = 0, torso_yaw = 0, torso_pitch = 0, torso_roll = 0, head_yaw = 0, head_pitch = 0;
  std::array<ArmControl, 2> arms;
};

using BodyPose = std::array<Rigid3d, kNumBodyParts>;  // world_from_part

/// Places all parts: the legs reach for the feet (two links, inverse kinematics), the hips go as high as they
/// let them, or to the seat.
BodyPose SolveBodyPose(const BodySize& size, const GaitState& gait, const UpperBody& upper);

/// How far behind where he stood before it a sitting person's hips are, and how high, metres.
double SeatedHipsBack(const BodySize& size);
double SeatedHipsHeight();

/// Someone to be drawn: body size, face, hair and clothes from a seed. Different `outfit`s (0, 1, 2 ...) of
/// a seed never wear the same cloth.
class Figure {
 public:
  Figure(uint64_t seed, int outfit, std::optional<double> height_m = std::nullopt);

  const BodySize& size() const { return size_; }
  /// One object for each garment and part, with the label; is_moving is left false.
  std::vector<SceneObject> ObjectsAt(const BodyPose& pose, uint8_t label) const;

 private:
  struct Garment {
    BodyPart part;
    std::shared_ptr<const Mesh> mesh;
    Material material;
  };

  BodySize size_;
  std::vector<Garment> garments_;
};

}  // namespace orbslam
