// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_detector.h"

#include "loop/ring.h"

namespace orbslam::test {
namespace {

class LoopDetectorTest : public Ring {
 protected:
  /// As LoopClosing does: list the keyframe, then ask.
  std::vector<KeyFrameId> See(int i) {
    const auto words = places_.Transform(*map_.Read()->Find(Id(i))->features);
    if (places_.Find(Id(i)) == nullptr) places_.Add(Id(i), words);
    return detector_.Detect(Id(i), *words);
  }
  /// All up to where the start comes into view again.
  void SeeLap() {
    for (int i = 0; i < kLap; ++i) {
      if (!See(i).empty()) {
        EXPECT_GT(i, kLap - 4) << "sees nothing again";
      }
    }
    detector_.Forget();
  }

  const LoopOptions options_;
  LoopDetector detector_{options_, map_, places_};
};

TEST_F(LoopDetectorTest, APlaceMustBeSeenThreeTimesInARow) {
  SeeLap();
  EXPECT_THAT(See(kLap), testing::IsEmpty());
  EXPECT_THAT(See(kLap + 1), testing::IsEmpty());
  const std::vector<KeyFrameId> found = See(kLap + 2);
  ASSERT_FALSE(found.empty());
  for (const KeyFrameId id : found) EXPECT_LE(id, Id(6)) << "is not near where the lap began";
}

TEST_F(LoopDetectorTest, AnInterruptionStartsTheCountAgain) {
  SeeLap();
  See(kLap);
  See(kLap + 1);
  See(12);  // elsewhere
  EXPECT_THAT(See(kLap + 2), testing::IsEmpty());
  EXPECT_THAT(See(kLap + 3), testing::IsEmpty());
  EXPECT_THAT(See(kLap + 4), testing::Not(testing::IsEmpty()));
}

TEST_F(LoopDetectorTest, ForgettingStartsTheCountAgain) {
  SeeLap();
  See(kLap);
  See(kLap + 1);
  detector_.Forget();
  EXPECT_THAT(See(kLap + 2), testing::IsEmpty());
}

TEST_F(LoopDetectorTest, KeyFramesThatAreGoneAreNoHarm) {
  SeeLap();
  See(kLap);
  See(kLap + 1);
  for (int i = 1; i < 6; ++i) map_.Write()->EraseKeyFrame(Id(i));
  for (const KeyFrameId id : See(kLap + 2)) EXPECT_NE(map_.Read()->Find(id), nullptr);
  EXPECT_THAT(detector_.Detect(Id(1), *places_.Find(Id(1))), testing::IsEmpty());
}

}  // namespace
}  // namespace orbslam::test
