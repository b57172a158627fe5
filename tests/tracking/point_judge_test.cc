// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/point_judge.h"

#include <gmock/gmock.h>

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

/// Two keyframes a second apart and the points that both see.
class PointJudgeTest : public SyntheticMap {
 protected:
  PointJudgeTest() {
    first_ = See(Rigid3d());
    AddKeyFrame(&first_);
    while (landmarks_of_.size() < 30) See(Rigid3d());  // time goes by
    second_ = SeeAndKnow(Rigid3d());
    AddKeyFrame(&second_);
    for (const MapPointId id : PointsOf(KeyFrameId(0)))
      if (NumObservations(id) == 2) shared_.push_back(id);
  }
  int NumObservations(MapPointId id) const {
    const auto map = map_.Read();
    return map->Find(id) == nullptr ? 0 : map->Find(id)->NumObservations();
  }
  std::pair<int, int> TakenFromBoth() const {
    return {judge_.NumTakenFrom(KeyFrameId(0)), judge_.NumTakenFrom(KeyFrameId(1))};
  }

  Frame first_, second_;
  std::vector<MapPointId> shared_;
  PointJudge judge_{sensor_, &map_};
};

TEST_F(PointJudgeTest, RetractsWhatWasSeenSinceAndCountsIt) {
  ASSERT_GT(shared_.size(), 100u);
  const std::vector<MapPointId> some(shared_.begin(), shared_.begin() + 20);
  judge_.Retract(some, second_.timestamp_s);
  EXPECT_EQ(TakenFromBoth(), std::pair(0, 0)) << "nothing is as young";
  judge_.Retract(some, first_.timestamp_s);
  for (const MapPointId id : some) EXPECT_EQ(NumObservations(id), 1);
  EXPECT_EQ(NumObservations(shared_[20]), 2) << "nobody spoke of it";
  EXPECT_EQ(TakenFromBoth(), std::pair(0, 20));
  judge_.Retract(some, -1);
  for (const MapPointId id : some) EXPECT_EQ(NumObservations(id), 0);
  EXPECT_EQ(TakenFromBoth(), std::pair(20, 20));
  ExpectSound();
}

TEST_F(PointJudgeTest, ErasesWhatMovingThingsKeepShowingAndCountsIt) {
  LocalMapTracker::Result found;
  found.on_moving.assign(shared_.begin(), shared_.begin() + 30);
  const Frame frame = See(Rigid3d());
  judge_.EraseCondemned();
  EXPECT_EQ(TakenFromBoth(), std::pair(0, 0));
  for (int i = 0; i < 10; ++i) judge_.Judge(found, frame, nullptr);
  {
    const auto map = map_.Write();
    map->EraseMapPoint(shared_[0]);  // by somebody else, in the meantime
  }
  judge_.EraseCondemned();
  for (const MapPointId id : found.on_moving) EXPECT_EQ(NumObservations(id), 0);
  judge_.EraseCondemned();
  EXPECT_EQ(TakenFromBoth(), std::pair(29, 29)) << "once";
  ExpectSound();
}

}  // namespace
}  // namespace orbslam::test
