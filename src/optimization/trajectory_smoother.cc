// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/trajectory_smoother.h"

#include <ceres/loss_function.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "optimization/acceleration_cost.h"

namespace orbslam {
namespace {

// Standard deviations from where on costs grow less than squared.
constexpr double kAccelerationWidth = 3, kPoseWidth = 2;

/// A pose stays where it is but for what is not known of it. The motion of a camera's frame is its pose's
/// correction in the world seen from that camera, with the opposite sign.
ceres::CostFunction* PriorOf(const UncertainPose& pose) {
  const Eigen::Matrix3d camera_from_world = pose.world_from_camera.RotationMatrix().transpose();
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = camera_from_world;
  const Matrix6d root = Eigen::SelfAdjointEigenSolver<Matrix6d>(pose.information).operatorSqrt() * turn;
  return new ceres::NormalPrior(root, ceres::Vector::Zero(6));
}

void AddPose(const UncertainPose& pose, ceres::LossFunction* loss, double* correction,
             ceres::Problem* problem) {
  problem->AddParameterBlock(correction, 6);
  if (pose.information.allFinite()) {
    problem->AddResidualBlock(PriorOf(pose), loss, correction);
  } else {
    problem->SetParameterBlockConstant(correction);
  }
}

/// What differs much is first believed a little, so that there is one solution; from there, hardly at all
/// (graduated non-convexity: Blake and Zisserman, Visual Reconstruction, 1987).
class Losses {
 public:
  template <class Loss>
  void Set() {
    acceleration_.Reset(new Loss(kAccelerationWidth), ceres::TAKE_OWNERSHIP);
    pose_.Reset(new Loss(kPoseWidth), ceres::TAKE_OWNERSHIP);
  }
  ceres::LossFunction* acceleration() { return &acceleration_; }
  ceres::LossFunction* pose() { return &pose_; }

 private:
  ceres::LossFunctionWrapper acceleration_{nullptr, ceres::TAKE_OWNERSHIP};
  ceres::LossFunctionWrapper pose_{nullptr, ceres::TAKE_OWNERSHIP};
};

bool Solve(ceres::Problem* problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  return summary.IsSolutionUsable();
}

bool SolveGradually(Losses* losses, ceres::Problem* problem) {
  losses->Set<ceres::HuberLoss>();
  if (!Solve(problem)) return false;
  losses->Set<ceres::CauchyLoss>();
  return Solve(problem);
}

}  // namespace

void SmoothTrajectory(const MotionPrior& prior, std::span<UncertainPose> poses) {
  if (prior.acceleration_mps2 <= 0 || prior.angular_acceleration_radps2 <= 0) return;
  std::vector<PoseCorrection> corrections(poses.size(), PoseCorrection{});
  Losses losses;
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  for (size_t i = 0; i < poses.size(); ++i) AddPose(poses[i], losses.pose(), corrections[i].data(), &problem);
  for (size_t i = 2; i < poses.size(); ++i) {
    const UncertainPose &a = poses[i - 2], &b = poses[i - 1], &c = poses[i];
    if (a.timestamp_s >= b.timestamp_s || b.timestamp_s >= c.timestamp_s) continue;
    problem.AddResidualBlock(new AccelerationCost(prior, a, b, c), losses.acceleration(),
                             corrections[i - 2].data(), corrections[i - 1].data(), corrections[i].data());
  }
  if (!SolveGradually(&losses, &problem)) return;
  for (size_t i = 0; i < poses.size(); ++i) {
    Rigid3d& pose = poses[i].world_from_camera;
    const Eigen::Map<const Vector6d> correction(corrections[i].data());
    pose.rotation = (So3Exp(correction.head<3>()) * pose.rotation).normalized();
    pose.translation += correction.tail<3>();
  }
}

}  // namespace orbslam
