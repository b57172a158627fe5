// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_split.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "normals.h"

namespace orbslam::test {
namespace {

const GridCamera kCamera{.width = 160, .height = 120, .fx = 130, .fy = 130, .cx = 79.5f, .cy = 59.5f};

/// Depth of what a cell's ray, with z = 1, meets; 0: nothing.
using Scene = std::function<float(float x, float y)>;

WorkingFrame See(const Scene& scene) {
  WorkingFrame frame;
  frame.depth_m = cv::Mat1f(kCamera.height, kCamera.width);
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u)
      frame.depth_m(v, u) = scene((static_cast<float>(u) - kCamera.cx) / kCamera.fx,
                                  (static_cast<float>(v) - kCamera.cy) / kCamera.fy);
  ComputeNormals(kCamera, &frame);
  return frame;
}

/// A camera 1 m above a floor looks down by 45 degrees; the floor ends 3 m away.
float Floor(float y) {
  const float z = std::sqrt(2.f) / (1 + y);
  return z > 0 && z < 3 ? z : 0;
}
/// An upright post of that radius, standing on it 1.2 m away.
float PostOnFloor(float x, float y, float radius_m) {
  const float floor = Floor(y), forward = 1.2f;
  // In the floor's frame: forward and down components of the ray.
  const float f = (1 - y) / std::sqrt(2.f), a = x * x + f * f, b = f * forward;
  const float root = b * b - a * (forward * forward - radius_m * radius_m);
  if (root < 0) return floor;
  const float z = (b - std::sqrt(root)) / a;
  return floor == 0 || z < floor ? z : floor;
}

int LabelAt(const Segmentation& segmentation, int u, int v) { return segmentation.labels(v, u); }

Segmentation SegmentAll(const WorkingFrame& frame, const SegmentationOptions& options = {}) {
  return SegmentSurfaces(kCamera, frame, cv::Mat1b(frame.depth_m.size(), uint8_t{255}), options);
}

TEST(PlaneSplit, AFloorIsNoPartOfWhatStandsOnIt) {
  const WorkingFrame frame = See([](float x, float y) { return PostOnFloor(x, y, 0.15f); });
  const Segmentation apart = SegmentAll(frame);
  EXPECT_NE(LabelAt(apart, 80, 50), LabelAt(apart, 20, 90));
  EXPECT_EQ(LabelAt(apart, 20, 90), LabelAt(apart, 140, 90));  // one floor, on both sides of the post
  EXPECT_TRUE(apart.clusters[LabelAt(apart, 20, 90)].is_flat);
  EXPECT_FALSE(apart.clusters[LabelAt(apart, 80, 50)].is_flat);
  SegmentationOptions joined;
  joined.use_planes = false;
  EXPECT_EQ(LabelAt(SegmentAll(frame, joined), 80, 50), LabelAt(SegmentAll(frame, joined), 20, 90));
}

TEST(PlaneSplit, EveryCellIsInTheClusterThatItsLabelNames) {
  const Segmentation apart = SegmentAll(See([](float x, float y) { return PostOnFloor(x, y, 0.15f); }));
  size_t num_labelled = 0, num_listed = 0;
  for (const int label : apart.labels) num_labelled += label >= 0;
  for (size_t c = 0; c < apart.clusters.size(); ++c)
    for (const int cell : apart.clusters[c].cells) {
      ++num_listed;
      ASSERT_EQ(apart.labels(cell), static_cast<int>(c));
    }
  EXPECT_EQ(num_listed, num_labelled);
}

TEST(PlaneSplit, WhatIsSmallOrRoundOrFoldedStaysWhole) {
  SegmentationOptions joined;
  joined.use_planes = false;
  const auto is_whole = [&](const Scene& scene) {
    const WorkingFrame frame = See(scene);
    return SegmentAll(frame).clusters.size() == SegmentAll(frame, joined).clusters.size();
  };
  // A trunk 0.5 m thick, a metre away; a flat box of 0.5 x 0.6 m; folds of a large cloth.
  EXPECT_TRUE(is_whole([](float x, float) {
    const float a = x * x + 1, root = 1.25f * 1.25f - a * (1.25f * 1.25f - 0.25f * 0.25f);
    return root < 0 ? 0 : (1.25f - std::sqrt(root)) / a;
  }));
  EXPECT_TRUE(
      is_whole([](float x, float y) { return std::abs(x) < 0.25f && std::abs(y) < 0.3f ? 1.f : 0.f; }));
  EXPECT_TRUE(is_whole([](float x, float y) {
    const bool is_cloth = std::abs(x) < 0.35f && std::abs(y) < 0.35f;
    return is_cloth ? 1.2f + 0.012f * std::sin(1.2f * x / 0.08f * 6.28f) : 0.f;
  }));
}

TEST(PlaneSplit, NoisyFloorsAreFlatToo) {
  cv::RNG rng(3);
  const Segmentation apart = SegmentAll(See([&](float x, float y) {
    const float z = PostOnFloor(x, y, 0.15f);
    return z + static_cast<float>(rng.gaussian(0.0012 + 0.0019 * (z - 0.4) * (z - 0.4)));
  }));
  EXPECT_NE(LabelAt(apart, 80, 50), LabelAt(apart, 20, 90));
  EXPECT_EQ(LabelAt(apart, 20, 90), LabelAt(apart, 140, 90));
}

}  // namespace
}  // namespace orbslam::test
