// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/pipeline/place_index.h"

#include <numeric>

#include "support/trained_vocabulary.h"
#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

class PlaceIndexTest : public SyntheticMap {
 protected:
  /// Three views that share no landmark: turned by 70 degrees each.
  PlaceIndexTest() : SyntheticMap(Around()) {
    for (uint32_t i = 0; i < 3; ++i) {
      places_.Add(KeyFrameId(i), places_.Transform(*See(Turned(i)).features));
    }
  }

  static std::vector<Landmark> Around() {
    Rng rng(5);
    const Sensor sensor = KinectSensor();
    std::vector<Landmark> all;
    for (int i = 0; i < 3; ++i) {
      for (Landmark& landmark : RandomLandmarks(sensor, 600, &rng)) {
        if (!sensor.bounds.Contains(Pixel(sensor, landmark).x(), Pixel(sensor, landmark).y())) continue;
        landmark.position_world = Inverse(Turned(i)) * landmark.position_world;
        all.push_back(landmark);
      }
    }
    return all;
  }
  static Eigen::Vector2f Pixel(const Sensor& sensor, const Landmark& landmark) {
    return sensor.camera.Project(landmark.position_world).cast<float>();
  }
  static Rigid3d Turned(int i) { return {So3Exp({0, 1.22 * i, 0}), {0, 0, 0}}; }

  std::vector<KeyFrameId> Alike(const PlaceIndex::Words& words, std::vector<KeyFrameId> excluded = {}) {
    std::vector<KeyFrameId> ids;
    for (const auto& candidate : places_.Query(words.bow, excluded)) ids.push_back(candidate.id);
    return ids;
  }

  PlaceIndex places_{TrainOn(landmarks_)};
};

TEST_F(PlaceIndexTest, APlaceSeenAgainIsTheBestAnswer) {
  for (uint32_t i = 0; i < 3; ++i) {
    const Rigid3d nearby = RandomMotion(&rng_, 0.05, 0.05) * Turned(static_cast<int>(i));
    EXPECT_EQ(Alike(*places_.Transform(*See(nearby).features)).at(0), KeyFrameId(i));
  }
}

TEST_F(PlaceIndexTest, ExcludedAndRemovedPlacesAreNotFound) {
  const auto words = places_.Transform(*See(Turned(1)).features);
  EXPECT_THAT(Alike(*words, {KeyFrameId(1)}), testing::Not(testing::Contains(KeyFrameId(1))));
  EXPECT_NE(places_.Find(KeyFrameId(1)), nullptr);
  places_.Remove(KeyFrameId(1));
  places_.Remove(KeyFrameId(1));
  EXPECT_THAT(Alike(*words), testing::Not(testing::Contains(KeyFrameId(1))));
  EXPECT_EQ(places_.Find(KeyFrameId(1)), nullptr);
  EXPECT_EQ(places_.Find(KeyFrameId(99)), nullptr);
}

TEST_F(PlaceIndexTest, EveryFeatureIsBelowOneNode) {
  const Frame frame = See(Turned(2));
  std::vector<int> features = places_.Transform(*frame.features)->direct_index.features;
  std::ranges::sort(features);
  std::vector<int> all(frame.features->size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(features, all);
}

}  // namespace
}  // namespace orbslam::test
