// SPDX-License-Identifier: GPL-3.0-or-later
#include "object_velocity.h"

#include <gtest/gtest.h>

namespace orbslam {
namespace {

constexpr GridCamera kCamera{40, 30, 32, 32, 19.5f, 14.5f};

/// One object in the left half of the image, one in the right.
class SetVelocitiesTest : public testing::Test {
 protected:
  SetVelocitiesTest() {
    frame_.depth_m = cv::Mat1f(kCamera.height, kCamera.width, 2.f);
    labelled_.object_of_cell = cv::Mat1i(frame_.depth_m.size(), 0);
    labelled_.object_of_cell.colRange(kCamera.width / 2, kCamera.width).setTo(1);
    labelled_.objects.resize(2);
    log_odds_ = cv::Mat1f(frame_.depth_m.size(), 1.f);
  }

  /// A cluster of that many cells of a row that moves so (m/s, along x); 0: nobody knows.
  void Add(int row, int first_column, int num_cells, float speed_mps) {
    Cluster cluster;
    for (int i = 0; i < num_cells; ++i) cluster.cells.push_back(row * kCamera.width + first_column + i);
    segmentation_.clusters.push_back(cluster);
    ClusterVerdict verdict;
    verdict.log_odds = 1;
    if (speed_mps != 0)
      verdict.motion = {{speed_mps, 0, 0}, Eigen::Vector3f::UnitX(), speed_mps * kPersistentTau, 0};
    verdicts_.push_back(verdict);
  }

  std::vector<DynamicObject> Velocities() {
    const SceneHistory nothing(kCamera, {}, 0);
    const HistogramWindow window(kCamera, nothing, frame_, {});
    SetVelocities(segmentation_, verdicts_, log_odds_, window, {}, &labelled_);
    return labelled_.objects;
  }

  WorkingFrame frame_;
  ObjectTracker::Labelled labelled_;
  cv::Mat1f log_odds_;
  Segmentation segmentation_;
  std::vector<ClusterVerdict> verdicts_;
};

TEST_F(SetVelocitiesTest, AreThoseOfTheLargestClusterThatHasOne) {
  Add(3, 2, 5, 0.3f), Add(5, 2, 9, 0.7f), Add(7, 2, 12, 0.f), Add(9, 22, 4, 1.1f);
  const std::vector<DynamicObject> objects = Velocities();
  EXPECT_FLOAT_EQ(static_cast<float>(objects[0].velocity_mps.x()), 0.7f);
  EXPECT_FLOAT_EQ(static_cast<float>(objects[0].line_integral_ratio), 0.7f);
  EXPECT_FLOAT_EQ(static_cast<float>(objects[1].velocity_mps.x()), 1.1f);
}

TEST_F(SetVelocitiesTest, WhatRestsAndWhatIsNoObjectGivesNone) {
  Add(3, 2, 5, 0.3f), Add(9, 22, 4, 1.1f);
  log_odds_.row(3).setTo(-1);
  labelled_.object_of_cell.row(9).setTo(-1);
  for (const DynamicObject& object : Velocities()) EXPECT_TRUE(object.velocity_mps.isZero());
}

}  // namespace
}  // namespace orbslam
