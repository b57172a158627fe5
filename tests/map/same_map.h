// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gmock/gmock.h>

#include "orbslam/map/map_data.h"
#include "orbslam/map/map_state.h"
#include "support/matchers.h"

namespace orbslam::test {

inline bool AreSame(const Rigid3d& a, const Rigid3d& b) {
  return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

inline void ExpectSame(const FrameFeatures& a, const FrameFeatures& b) {
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.angles_deg, b.angles_deg);
  EXPECT_EQ(a.levels, b.levels);
  EXPECT_EQ(a.descriptors, b.descriptors);
  EXPECT_EQ(a.depths_m, b.depths_m);
  EXPECT_EQ(a.right_u, b.right_u);
  std::vector<int> near_a, near_b;
  a.grid.Near(100, 100, 80, a.pixels, a.levels, 0, 9, &near_a);
  b.grid.Near(100, 100, 80, b.pixels, b.levels, 0, 9, &near_b);
  EXPECT_EQ(near_a, near_b);
}

inline void ExpectSame(const KeyFrame& a, const KeyFrame& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.frame_id, b.frame_id);
  EXPECT_EQ(a.timestamp_s, b.timestamp_s);
  EXPECT_TRUE(AreSame(a.camera_from_world, b.camera_from_world));
  ExpectSame(*a.features, *b.features);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.covisibles, b.covisibles);
  EXPECT_EQ(a.parent, b.parent);
  EXPECT_EQ(a.children, b.children);
  EXPECT_EQ(a.loop_edges, b.loop_edges);
}

inline void ExpectSame(const MapPoint& a, const MapPoint& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.position_world, b.position_world);
  EXPECT_EQ(a.normal_world, b.normal_world);
  EXPECT_EQ(a.descriptor, b.descriptor);
  EXPECT_EQ(a.min_distance_m, b.min_distance_m);
  EXPECT_EQ(a.max_distance_m, b.max_distance_m);
  EXPECT_EQ(a.created_by, b.created_by);
  EXPECT_EQ(a.observations, b.observations);
  EXPECT_EQ(a.times_visible, b.times_visible);
  EXPECT_EQ(a.times_found, b.times_found);
}

/// Equal in everything that can be seen of them, to the last bit.
inline void ExpectSame(const MapData& a, const MapData& b) {
  EXPECT_TRUE(a.pyramid() == b.pyramid());
  EXPECT_EQ(a.epoch(), b.epoch());
  ASSERT_EQ(a.num_keyframes(), b.num_keyframes());
  ASSERT_EQ(a.num_points(), b.num_points());
  ASSERT_EQ(a.last_keyframe_id(), b.last_keyframe_id());
  const uint32_t num_point_ids = a.Export().num_point_ids;
  ASSERT_EQ(num_point_ids, b.Export().num_point_ids);
  for (const KeyFrame& keyframe : a.KeyFrames()) {
    ASSERT_NE(b.Find(keyframe.id), nullptr);
    ExpectSame(keyframe, *b.Find(keyframe.id));
  }
  for (const MapPoint& point : a.MapPoints()) {
    ASSERT_NE(b.Find(point.id), nullptr);
    ExpectSame(point, *b.Find(point.id));
  }
  for (KeyFrameId id(0); id.value < a.last_keyframe_id().value + 1; ++id.value) {
    ASSERT_EQ(a.Resolve(id), b.Resolve(id));
    ASSERT_TRUE(AreSame(*a.CameraFromWorld(id), *b.CameraFromWorld(id)));
  }
  for (MapPointId id(0); id.value < num_point_ids; ++id.value) ASSERT_EQ(a.Resolve(id), b.Resolve(id));
}

}  // namespace orbslam::test
