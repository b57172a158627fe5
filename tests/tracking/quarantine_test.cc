// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/quarantine.h"

#include <gmock/gmock.h>

namespace orbslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

void Refute(Quarantine* quarantine, MapPointId id, int num_frames) {
  for (int i = 0; i < num_frames; ++i) quarantine->Refute(id);
}

TEST(Quarantine, CondemnsAfterEnoughFramesAndOnce) {
  Quarantine quarantine;
  Refute(&quarantine, MapPointId(7), Quarantine::kMinFrames - 1);
  EXPECT_THAT(quarantine.TakeCondemned(), IsEmpty());
  Refute(&quarantine, MapPointId(7), 1);
  EXPECT_THAT(quarantine.TakeCondemned(), ElementsAre(MapPointId(7)));
  EXPECT_THAT(quarantine.TakeCondemned(), IsEmpty());
}

TEST(Quarantine, APointFoundStaticStartsAnew) {
  Quarantine quarantine;
  Refute(&quarantine, MapPointId(7), Quarantine::kMinFrames - 1);
  quarantine.FoundStatic(MapPointId(7));
  Refute(&quarantine, MapPointId(7), Quarantine::kMinFrames - 1);
  EXPECT_THAT(quarantine.TakeCondemned(), IsEmpty());
}

TEST(Quarantine, PointsAreCountedApartAndComeOutInOrder) {
  Quarantine quarantine;
  for (const uint32_t id : {9u, 2u, 5u}) Refute(&quarantine, MapPointId(id), Quarantine::kMinFrames);
  Refute(&quarantine, MapPointId(3), Quarantine::kMinFrames - 1);
  EXPECT_THAT(quarantine.TakeCondemned(), ElementsAre(MapPointId(2), MapPointId(5), MapPointId(9)));
}

}  // namespace
}  // namespace orbslam
