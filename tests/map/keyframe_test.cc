// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/map/keyframe.h"

#include <gtest/gtest.h>

#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {
namespace {

TEST(KeyFrame, BestCovisiblesAreTheMostThenTheOldestOfThoseThatShareEnough) {
  Rng rng(13);
  KeyFrame keyframe;
  for (uint32_t id = 0; id < 200; ++id) {
    keyframe.covisibles.push_back({KeyFrameId(id), static_cast<int>(1 + rng.Below(40))});
  }
  const auto weight = [&](KeyFrameId id) { return keyframe.covisibles[id.value].num_shared_points; };
  constexpr int kMinShared = 15;
  const std::vector<KeyFrameId> best = keyframe.BestCovisibles(1000, kMinShared);
  for (size_t i = 0; i + 1 < best.size(); ++i) {
    EXPECT_GE(weight(best[i]), weight(best[i + 1]));
    EXPECT_TRUE(weight(best[i]) > weight(best[i + 1]) || best[i] < best[i + 1]);
  }
  const auto num_enough = std::ranges::count_if(
      keyframe.covisibles, [](const Covisible& c) { return c.num_shared_points >= kMinShared; });
  EXPECT_EQ(std::ssize(best), num_enough);
  EXPECT_GE(weight(best.back()), kMinShared);

  const std::vector<KeyFrameId> few = keyframe.BestCovisibles(10, kMinShared);
  EXPECT_EQ(few, std::vector<KeyFrameId>(best.begin(), best.begin() + 10)) << "a shorter list is a prefix";
}

TEST(KeyFrame, CentreIsWhereTheCameraIs) {
  Rng rng(14);
  KeyFrame keyframe;
  keyframe.camera_from_world = RandomMotion(&rng);
  EXPECT_THAT(keyframe.camera_from_world * keyframe.CenterWorld(),
              MatrixNear(Eigen::Vector3d::Zero(), 1e-14));
}

}  // namespace
}  // namespace orbslam::test
