// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/pose_refinement.h"

#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

/// A keyframe at time 0 has made all points.
class PoseRefinementTest : public SyntheticMap {
 protected:
  static constexpr double kMovedM = 0.004;  // a pixel or so: within the gate

  PoseRefinementTest() {
    Frame first = SeeAndKnow(Rigid3d());
    AddKeyFrame(&first);
  }

  /// The weights of the points of `frame`, and how many each has.
  std::map<double, int> CountWeights(Frame* frame) {
    std::map<double, int> count;
    for (const PoseObservation& o : GatherPoseProblem(map_, sensor_, frame).problem.observations)
      ++count[o.weight];
    return count;
  }

  Frame SeeAt(double timestamp_s) {
    Frame frame = SeeAndKnow(Rigid3d());
    frame.timestamp_s = timestamp_s;
    return frame;
  }
};

TEST_F(PoseRefinementTest, PointsCountForLessUntilTheyHaveStood) {
  Frame young = SeeAt(kProbationS - 0.01), old = SeeAt(kProbationS + 0.01);
  EXPECT_THAT(CountWeights(&young), testing::ElementsAre(testing::Pair(kProbationWeight, testing::Gt(300))));
  EXPECT_THAT(CountWeights(&old), testing::ElementsAre(testing::Pair(1.0, testing::Gt(300))));
}

TEST_F(PoseRefinementTest, AMapOfALaterClockHasStood) {
  Frame earlier = SeeAt(-1000);
  EXPECT_THAT(CountWeights(&earlier), testing::ElementsAre(testing::Pair(1.0, testing::Gt(300))));
}

TEST_F(PoseRefinementTest, YoungPointsThatMoveTogetherHardlyMoveTheCamera) {
  Frame frame = SeeAt(2 * kProbationS);
  {
    const auto guard = map_.Write();  // as if every other point were a new keyframe's, and had moved since
    const KeyFrameId second = guard->AddKeyFrame(frame.id, frame.timestamp_s - 0.1, Rigid3d(), frame.features);
    guard->ConnectToSpanningTree(second, KeyFrameId(0));
    for (int i = 0; i < frame.features->size(); i += 2) {
      if (!frame.points[i].IsValid()) continue;
      MapPoint* point = guard->Find(frame.points[i]);
      point->created_by = second;
      point->position_world.x() += kMovedM;
    }
  }
  EXPECT_GT(RefinePose(map_, sensor_, &frame), 300);
  const double shift_m = Inverse(frame.camera_from_world).translation.norm();
  EXPECT_GT(shift_m, 0.1 * kMovedM);   // heard, ...
  EXPECT_LT(shift_m, 0.35 * kMovedM);  // ... but as a fifth of the votes instead of half
}

}  // namespace
}  // namespace orbslam::test
