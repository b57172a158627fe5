// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/keyframe_policy.h"

#include <gtest/gtest.h>

#include <functional>

#include "orbslam/util/random.h"

namespace orbslam::test {
namespace {

int Count(Rng* rng, uint32_t below) { return static_cast<int>(rng->Below(below)); }

/// Evidence spread over both sides of every threshold.
KeyFrameEvidence RandomEvidence(Rng* rng) {
  return {.since_last_keyframe_s = rng->Uniform(0, 2),
          .num_inliers = Count(rng, 300),
          .num_shared_points = Count(rng, 400),
          .num_reference_points = Count(rng, 600),
          .num_erased_points = Count(rng, 200),
          .num_tracked_close = Count(rng, 200),
          .num_untracked_close = Count(rng, 140),
          .is_mapper_idle = rng->Below(2) == 0};
}

/// Each change makes a keyframe more wanted, never less.
const std::pair<const char*, std::function<void(KeyFrameEvidence*, Rng*)>> kPushes[] = {
    {"more time", [](KeyFrameEvidence* e, Rng* rng) { e->since_last_keyframe_s += rng->Uniform(0, 2); }},
    {"a richer reference", [](KeyFrameEvidence* e, Rng* rng) { e->num_reference_points += Count(rng, 300); }},
    {"more of it that moved", [](KeyFrameEvidence* e, Rng* rng) { e->num_erased_points += Count(rng, 300); }},
    {"a better known one", [](KeyFrameEvidence* e, Rng* rng) { e->num_shared_points += Count(rng, 200); }},
    {"fewer close points", [](KeyFrameEvidence* e, Rng* rng) { e->num_tracked_close -= Count(rng, 100); }},
    {"more to be made", [](KeyFrameEvidence* e, Rng* rng) { e->num_untracked_close += Count(rng, 100); }},
    {"an idle mapper", [](KeyFrameEvidence* e, Rng*) { e->is_mapper_idle = true; }},
    {"fewer inliers, but enough",
     [](KeyFrameEvidence* e, Rng* rng) {
       const int least = KeyFramePolicyOptions().min_inliers + 1;
       if (e->num_inliers > least) e->num_inliers = least + Count(rng, e->num_inliers - least);
     }},
};

TEST(KeyFramePolicy, IsMonotoneInEveryPieceOfEvidence) {
  Rng rng(22);
  const KeyFramePolicyOptions options;
  for (const auto& [what, push] : kPushes) {
    int num_wanted = 0, num_tipped = 0;
    for (int i = 0; i < 5000; ++i) {
      KeyFrameEvidence evidence = RandomEvidence(&rng);
      const bool before = NeedsKeyFrame(evidence, options);
      push(&evidence, &rng);
      const bool after = NeedsKeyFrame(evidence, options);
      EXPECT_TRUE(after || !before) << what;
      num_wanted += before;
      num_tipped += after && !before;
    }
    EXPECT_GT(num_wanted, 100) << what;
    EXPECT_GT(num_tipped, 10) << what << " never mattered";
  }
}

/// A well-tracked frame that sees nothing new.
constexpr KeyFrameEvidence kContent{.num_inliers = 300,
                                    .num_shared_points = 320,
                                    .num_reference_points = 400,
                                    .num_tracked_close = 200,
                                    .num_untracked_close = 10};

TEST(KeyFramePolicy, TimeAloneMakesNoKeyFrame) {
  KeyFrameEvidence evidence = kContent;
  evidence.since_last_keyframe_s = 1000;
  EXPECT_FALSE(NeedsKeyFrame(evidence, {}));
}

TEST(KeyFramePolicy, PoorlyTrackedFrameNeverBecomesOne) {
  Rng rng(23);
  for (int i = 0; i < 1000; ++i) {
    KeyFrameEvidence evidence = RandomEvidence(&rng);
    evidence.num_inliers = Count(&rng, static_cast<uint32_t>(KeyFramePolicyOptions().min_inliers + 1));
    EXPECT_FALSE(NeedsKeyFrame(evidence, {}));
  }
}

TEST(KeyFramePolicy, BusyMapperIsSparedUnlessItIsUrgent) {
  KeyFrameEvidence evidence = kContent;
  evidence.num_inliers = 200;  // of 320: something new, nothing urgent
  EXPECT_TRUE(NeedsKeyFrame(evidence, {}));
  evidence.is_mapper_idle = false;
  EXPECT_FALSE(NeedsKeyFrame(evidence, {}));

  KeyFrameEvidence overdue = evidence, weak = evidence, lacks_close = evidence;
  overdue.since_last_keyframe_s = 1;
  weak.num_inliers = 50;
  lacks_close.num_tracked_close = 50, lacks_close.num_untracked_close = 100;
  for (const auto& urgent : {overdue, weak, lacks_close}) EXPECT_TRUE(NeedsKeyFrame(urgent, {}));
}

TEST(KeyFramePolicy, NewTerritoryCountsBeforeAnyOtherKeyFrameHasSeenIt) {
  KeyFrameEvidence evidence = kContent;
  evidence.num_shared_points = 20;  // a keyframe of new things
  evidence.num_reference_points = 1000;
  evidence.num_inliers = 650;
  EXPECT_FALSE(NeedsKeyFrame(evidence, {}));
  evidence.num_inliers = 300;  // fifteen times what is shared, but most of it is out of sight
  EXPECT_TRUE(NeedsKeyFrame(evidence, {}));
}

}  // namespace
}  // namespace orbslam::test
