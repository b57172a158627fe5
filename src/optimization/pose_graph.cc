// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/optimization/pose_graph.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <memory>

#include "optimization/pose_block.h"
#include "optimization/relative_pose_cost.h"
#include "optimization/stop_callback.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

ceres::Problem::Options SharedManifold() {
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

void AddNode(bool is_fixed, PoseBlock* block, ceres::Manifold* manifold, ceres::Problem* problem) {
  problem->AddParameterBlock(block->rotation.data(), 4, manifold);
  problem->AddParameterBlock(block->translation.data(), 3);
  if (!is_fixed) return;
  problem->SetParameterBlockConstant(block->rotation.data());
  problem->SetParameterBlockConstant(block->translation.data());
}

ceres::Solver::Options SolverOptions(const PoseGraphOptions& options, StopCallback* callback) {
  ceres::Solver::Options result;
  result.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  result.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  result.max_num_iterations = options.max_iterations;
  result.logging_type = ceres::SILENT;
  result.callbacks.push_back(callback);
  return result;
}

}  // namespace

PoseGraphSummary SolvePoseGraph(const PoseGraphOptions& options, std::stop_token stop, PoseGraph* graph) {
  ceres::EigenQuaternionManifold manifold;
  ceres::HuberLoss huber(options.huber_width > 0 ? options.huber_width : 1);
  ceres::Problem problem(SharedManifold());
  std::vector<PoseBlock> blocks;
  blocks.reserve(graph->nodes.size());
  for (const PoseGraphNode& node : graph->nodes) blocks.emplace_back(node.camera_from_world);
  for (size_t i = 0; i < blocks.size(); ++i) {
    AddNode(graph->nodes[i].is_fixed, &blocks[i], &manifold, &problem);
  }
  const int num_nodes = static_cast<int>(blocks.size());
  for (const PoseGraphEdge& edge : graph->edges) {
    ORBSLAM_CHECK(edge.a >= 0 && edge.a < num_nodes && edge.b >= 0 && edge.b < num_nodes && edge.a != edge.b);
    PoseBlock &a = blocks[edge.a], &b = blocks[edge.b];
    problem.AddResidualBlock(new RelativePoseCost(edge, options), options.huber_width > 0 ? &huber : nullptr,
                             a.rotation.data(), a.translation.data(), b.rotation.data(),
                             b.translation.data());
  }

  StopCallback callback(stop);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options, &callback), &problem, &summary);
  if (summary.IsSolutionUsable()) {
    for (size_t i = 0; i < blocks.size(); ++i) {
      if (!graph->nodes[i].is_fixed) graph->nodes[i].camera_from_world = blocks[i].Pose();
    }
  }
  return {summary.initial_cost, summary.final_cost, summary.IsSolutionUsable()};
}

}  // namespace orbslam
