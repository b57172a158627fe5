// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/motion_vectors.h"

#include <pcl/kdtree/kdtree_flann.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "orbslam/util/check.h"
#include "paper_cloud.h"

namespace orbslam {
namespace {

constexpr float kMinRadiusM = 0.15F;
constexpr float kRadiusPerMetre = 0.15F;
constexpr float kRadiusPerRms = 1.2F;

Eigen::Vector3f Centroid(std::span<const Eigen::Vector3f> points_m) {
  ORBSLAM_CHECK(!points_m.empty());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points_m) sum += point.cast<double>();
  return (sum / static_cast<double>(points_m.size())).cast<float>();
}

}  // namespace

float MotionBallRadiusM(float distance_m) { return std::max(kMinRadiusM, kRadiusPerMetre * distance_m); }

MotionBall BallAtDistance(std::span<const Eigen::Vector3f> points_m) {
  const Eigen::Vector3f centre = Centroid(points_m);
  return {centre, MotionBallRadiusM(centre.norm())};
}

MotionBall BallAroundCluster(std::span<const Eigen::Vector3f> points_m) {
  const Eigen::Vector3f centre = Centroid(points_m);
  double squared = 0;
  for (const Eigen::Vector3f& point : points_m) squared += (point - centre).squaredNorm();
  const auto rms = static_cast<float>(std::sqrt(squared / static_cast<double>(points_m.size())));
  return {centre, std::max(kMinRadiusM, kRadiusPerRms * rms)};
}

std::vector<Eigen::Vector3f> PointsInBall(std::span<const Eigen::Vector3f> points_m, const MotionBall& ball) {
  std::vector<Eigen::Vector3f> inside;
  std::copy_if(points_m.begin(), points_m.end(), std::back_inserter(inside),
               [&](const Eigen::Vector3f& point) { return ball.Contains(point); });
  return inside;
}

std::vector<Eigen::Vector3f> MotionVectors(std::span<const Eigen::Vector3f> points_m,
                                           std::span<const Eigen::Vector3f> previous_m) {
  std::vector<Eigen::Vector3f> vectors;
  if (previous_m.empty()) return vectors;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);
  tree.setInputCloud(ToPcl(previous_m));
  pcl::Indices nearest(1);
  std::vector<float> squared_distance(1);
  vectors.reserve(points_m.size());
  for (const Eigen::Vector3f& point : points_m) {
    tree.nearestKSearch(pcl::PointXYZ(point.x(), point.y(), point.z()), 1, nearest, squared_distance);
    vectors.push_back(point - previous_m[nearest[0]]);
  }
  return vectors;
}

std::optional<Eigen::Vector3f> MotionDirection(std::span<const Eigen::Vector3f> vectors_m) {
  // The right singular vectors of V are the eigenvectors of V^T V, a 3 x 3 matrix however many the rows.
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& vector : vectors_m) {
    const Eigen::Vector3d v = vector.cast<double>();
    scatter += v * v.transpose();
    sum += v;
  }
  if (!(scatter.trace() > 0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d dominant = solver.eigenvectors().col(2);
  return (dominant.dot(sum) < 0 ? Eigen::Vector3d(-dominant) : dominant).cast<float>();
}

}  // namespace orbslam
