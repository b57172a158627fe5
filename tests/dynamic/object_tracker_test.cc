// SPDX-License-Identifier: GPL-3.0-or-later
#include "object_tracker.h"

#include <gmock/gmock.h>

namespace orbslam {
namespace {

constexpr GridCamera kCamera{160, 120, 130, 130, 79.5f, 59.5f};

ObjectTracker::Labelled Update(ObjectTracker* tracker, const std::vector<cv::Rect>& things) {
  WorkingFrame frame;
  frame.depth_m = cv::Mat1f(kCamera.height, kCamera.width, 2.f);
  cv::Mat1b moving(frame.depth_m.size(), uint8_t{0});
  for (const cv::Rect& thing : things) moving(thing).setTo(255);
  const cv::Mat1f log_odds(frame.depth_m.size(), 3.f);
  const cv::Mat2f shift(frame.depth_m.size(), cv::Vec2f(0, 0));
  return tracker->Update(kCamera, 16, moving, frame, log_odds, shift);
}

TEST(ObjectTracker, KeepsIdsWhileThingsOverlap) {
  ObjectTracker tracker;
  const auto first = Update(&tracker, {{10, 10, 20, 40}, {100, 10, 20, 40}});
  const auto second = Update(&tracker, {{104, 12, 20, 40}, {14, 10, 20, 40}});
  ASSERT_EQ(first.objects.size(), 2u);
  ASSERT_EQ(second.objects.size(), 2u);
  EXPECT_EQ(second.objects[second.object_of_cell(30, 20)].id, first.objects[first.object_of_cell(30, 15)].id);
  EXPECT_EQ(second.objects[second.object_of_cell(30, 110)].id,
            first.objects[first.object_of_cell(30, 105)].id);
}

TEST(ObjectTracker, NeverGivesAnIdTwice) {
  ObjectTracker tracker;
  const int id = Update(&tracker, {{10, 10, 20, 40}}).objects.front().id;
  Update(&tracker, {});
  EXPECT_NE(Update(&tracker, {{10, 10, 20, 40}}).objects.front().id, id);
}

TEST(ObjectTracker, SaysWhereAndHowLarge) {
  ObjectTracker tracker;
  const DynamicObject object = Update(&tracker, {{75, 55, 10, 10}}).objects.front();
  EXPECT_NEAR((object.centroid_m - Eigen::Vector3d(0, 0, 2)).norm(), 0, 0.01);
  EXPECT_EQ(object.num_pixels, 1600);
}

}  // namespace
}  // namespace orbslam
