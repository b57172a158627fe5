// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace orbslam {

/// The part of a cluster whose motion is looked at: B = { y in P : |y - P_c| <= r }. Metres, camera frame of
/// the current depth image.
struct MotionBall {
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();
  float radius_m = 0;

  bool Contains(const Eigen::Vector3f& point_m) const {
    return (point_m - centre_m).squaredNorm() <= radius_m * radius_m;
  }
};

/// r for a cluster whose centroid is distance_m away: 0.15 m up to one metre and 0.15 of the distance beyond.
/// The published method only says that r grows with the distance. A constant angle keeps the number of sensor
/// pixels in the ball, and so the statistics of V and of the histogram, the same at every range.
float MotionBallRadiusM(float distance_m);

/// The published ball: round the centroid of the points, with MotionBallRadiusM. `points_m` is not empty.
MotionBall BallAtDistance(std::span<const Eigen::Vector3f> points_m);

/// A ball of the cluster's own size: 1.2 times the RMS distance to the centroid, at least 0.15 m. It takes in
/// nearly all of a compact cluster at any range. `points_m` is not empty.
MotionBall BallAroundCluster(std::span<const Eigen::Vector3f> points_m);

/// The points inside the ball, in their order.
std::vector<Eigen::Vector3f> PointsInBall(std::span<const Eigen::Vector3f> points_m, const MotionBall& ball);

/// V(x) = x - its nearest neighbour in the previous cluster, metres, one a point; both in the current camera
/// frame. Empty when the previous cluster is.
std::vector<Eigen::Vector3f> MotionVectors(std::span<const Eigen::Vector3f> points_m,
                                           std::span<const Eigen::Vector3f> previous_m);

/// W: the unit vector along which the V(x) are longest together, that is the dominant right singular vector
/// of the matrix whose rows they are, with its sign along their mean. Nothing when all are zero or there are
/// none.
std::optional<Eigen::Vector3f> MotionDirection(std::span<const Eigen::Vector3f> vectors_m);

}  // namespace orbslam
