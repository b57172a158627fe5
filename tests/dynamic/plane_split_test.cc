// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_split.h"

#include <gmock/gmock.h>

#include <cmath>

#include "depth_scene.h"

namespace orbslam::test {
namespace {

int LabelAt(const Segmentation& segmentation, int u, int v) { return segmentation.labels(v, u); }

Segmentation SegmentAll(const WorkingFrame& frame, const SegmentationOptions& options = {}) {
  return SegmentSurfaces(kCellCamera, frame, cv::Mat1b(frame.depth_m.size(), uint8_t{255}), options);
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
  const auto is_whole = [&](const DepthScene& scene) {
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
