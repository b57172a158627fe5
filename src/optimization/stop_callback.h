// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/iteration_callback.h>

#include <stop_token>
#include <utility>

namespace orbslam {

/// Ends a solve after the iteration in which a stop was asked for; the best estimate is kept.
class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(std::stop_token stop) : stop_(std::move(stop)) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_.stop_requested() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  std::stop_token stop_;
};

}  // namespace orbslam
