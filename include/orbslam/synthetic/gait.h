// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace orbslam {

/// Where someone stands: metres on the floor, and the direction he faces, radians from +x towards +y.
struct Placement {
  Eigen::Vector2d position{0, 0};
  double heading = 0;
};

/// The unit vectors ahead and to the left of a heading.
Eigen::Vector2d Ahead(double heading);
Eigen::Vector2d LeftOf(double heading);

/// Rises from 0 to 1 over [0, 1] with both ends at rest; constant outside.
double SmoothStep(double x);

/// Angles of a leg in the plane of walking, radians; flexion positive, dorsiflexion positive.
struct LegAngles {
  double hip = 0, knee = 0, ankle = 0;
};

/// Level walking at a natural cadence: phase 0 is the heel's strike, 1 the next of the same foot. Fourier
/// series of four harmonics fitted to key values as in Winter, "The Biomechanics and Motor Control of Human
/// Gait", 1991 (hip 20 to -12 degrees, knee 65 in the swing, push-off of 20 at the ankle).
LegAngles WalkingAngles(double phase);

/// Lengths of a foot in its shoe, metres, along the sole from below the ankle.
struct FootShape {
  double ankle_height = 0.085, heel = 0.055, ball = 0.125, toe = 0.195;
};

/// A foot in the world. It is hinged at the ball: pitch turns heel to ball, toe_pitch ball to tip; positive
/// lifts the front.
struct FootState {
  Eigen::Vector3d ankle{0, 0, 0};  // metres
  double heading = 0, pitch = 0, toe_pitch = 0;
  bool planted = true;  // carries weight: heel or ball rest at their place on the floor
};

/// The point of the sole `along` metres ahead of the ankle (between -heel and ball), world frame.
Eigen::Vector3d SolePoint(const FootShape& shape, const FootState& foot, double along);

/// What the lower body does at one moment. Index 0 is left.
struct GaitState {
  Placement body;     // the middle of the hips, standing or seen from above
  double sway_m = 0;  // of the hips to the left, over the foot that carries
  double seated = 0;  // 0: stands, 1: sits
  std::array<FootState, 2> feet;
};

/// A walk made of footprints: a foot that carries stays where it is because its print says so, and the body
/// moves by half a step for each foot set down. Built move by move, then a pure function of time.
class GaitPlan {
 public:
  GaitPlan(const Placement& start, double half_stance_m, const FootShape& shape);

  void Stand(double duration_s);
  /// On the spot, by the shorter way.
  void TurnTo(double heading);
  /// Turns to the target, walks there in a straight line and stands with the feet together. speed: m/s,
  /// of the middle of the walk; positive.
  void WalkTo(const Eigen::Vector2d& target, double speed);
  void SitDown();
  void StandUp();
  /// Repeats for ever from here, back at the start: the last placement must be the first, and the first move
  /// to Stand.
  void Loop();
  /// At(0) will be `time_s` of the plan: before it all has happened already.
  void StartAt(double time_s) { first_s_ = time_s; }

  double duration_s() const { return end_s_; }
  const Placement& end() const { return end_; }
  const FootShape& shape() const { return shape_; }
  /// Before the plan's start and after the last move (without Loop): stands as at the first and the last
  /// moment.
  GaitState At(double time_s) const;

 private:
  enum class Kind { kStand, kTurn, kWalk, kSit };
  struct Piece {  // of the body's motion
    Kind kind;
    double start_s, end_s;
    Placement from, to;
    int num_steps;
    double seated_from, seated_to;
  };
  struct Step {  // of one foot, while it is in the air
    double start_s, end_s;
    Placement from, to;
  };

  Placement Print(int foot, const Placement& body) const;
  void AddStep(int foot, double start_s, double duration_s, const Placement& print);
  void AddPiece(Kind kind, double duration_s, const Placement& to, int num_steps, double seated);
  FootState FootAt(int foot, double time_s) const;
  FootState Swing(const Step& step, double fraction) const;

  double half_stance_m_;
  FootShape shape_;
  bool loops_ = false;
  double end_s_ = 0, first_s_ = 0, seated_ = 0;
  Placement start_, end_;
  std::array<Placement, 2> prints_;
  std::vector<Piece> pieces_;
  std::array<std::vector<Step>, 2> steps_;
};

}  // namespace orbslam
