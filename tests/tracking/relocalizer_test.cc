// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/relocalizer.h"

#include "support/trained_vocabulary.h"
#include "tracking/synthetic_map.h"

namespace orbslam::test {
namespace {

/// With a vocabulary, or without.
class RelocalizerTest : public SyntheticMap, public testing::WithParamInterface<bool> {
 protected:
  static constexpr int kKeyFrames = 12;

  RelocalizerTest() {
    for (int i = 0; i < kKeyFrames; ++i) {  // turning from left to right
      Frame frame = SeeAndKnow({So3Exp({0, 0.08 * (i - kKeyFrames / 2), 0}), RandomVector(&rng_, 0.05)});
      const KeyFrameId id = AddKeyFrame(&frame);
      places_.Add(id, places_.Transform(*frame.features));
    }
  }
  Relocalizer Make() const { return {map_, GetParam() ? &places_ : nullptr, sensor_, RelocalizerOptions()}; }

  static Rigid3d Turned(double angle_rad) { return {So3Exp({0, angle_rad, 0}), {0.03, -0.02, 0.04}}; }

  PlaceIndex places_{TrainOn(landmarks_)};
};

TEST_P(RelocalizerTest, FindsAViewOfTheMapWithoutAnyPrior) {
  Relocalizer relocalizer = Make();
  for (const double angle_rad : {-0.3, -0.1, 0.13, 0.28}) {
    Frame frame = See(Turned(angle_rad));
    frame.camera_from_world = RandomMotion(&rng_);
    bool is_found = false;
    for (int tries = 0; tries < 2 && !is_found; ++tries) is_found = relocalizer.Relocalize(&frame);
    ASSERT_TRUE(is_found) << angle_rad;
    EXPECT_THAT(frame.camera_from_world, Rigid3dNear(Turned(angle_rad), 0.003, 0.003));
    EXPECT_GE(frame.NumPoints(), RelocalizerOptions().min_inliers);
    EXPECT_GT(ShareOfRightPoints(frame), 0.99);
  }
}

TEST_P(RelocalizerTest, RolledCameraIsFoundToo) {
  const Rigid3d truth = Rigid3d{So3Exp({0, 0, 0.6}), {0, 0, 0}} * Turned(0.1);
  Relocalizer relocalizer = Make();
  Frame frame = See(truth);
  ASSERT_TRUE(relocalizer.Relocalize(&frame) || relocalizer.Relocalize(&frame));
  EXPECT_THAT(frame.camera_from_world, Rigid3dNear(truth, 0.003, 0.003));
}

TEST_P(RelocalizerTest, AStripBesideSomebodyWhoFillsThePictureIsEnough) {
  const Frame all = See(Turned(0.1));
  FrameFeatures features = *all.features;
  int num_visible = 0;
  for (int i = 0; i < features.size(); ++i) {
    const bool is_visible = features.pixels[i].x > 0.95f * static_cast<float>(sensor_.camera.width);
    num_visible += is_visible;
    if (!is_visible) features.descriptors[i] = RandomDescriptor(&rng_);
  }
  ASSERT_LT(num_visible, 50);
  Frame frame = all;
  frame.features = std::make_shared<const FrameFeatures>(std::move(features));
  Relocalizer relocalizer = Make();
  ASSERT_TRUE(relocalizer.Relocalize(&frame) || relocalizer.Relocalize(&frame));
  EXPECT_THAT(frame.camera_from_world, Rigid3dNear(Turned(0.1), 0.003, 0.003));
}

TEST_P(RelocalizerTest, AnotherPlaceIsRefused) {
  Rng rng(99);
  const SyntheticView elsewhere = test::See(sensor_, RandomLandmarks(sensor_, 1600, &rng), Rigid3d(), &rng);
  Frame frame = MakeFrame(FrameId(50), 2, elsewhere, Rigid3d());
  Relocalizer relocalizer = Make();
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(relocalizer.Relocalize(&frame));
    EXPECT_EQ(frame.NumPoints(), 0);
  }
}

TEST_P(RelocalizerTest, TheSameThingsInAnotherArrangementAreRefused) {
  const Frame seen = See(Turned(0));
  FrameFeatures shuffled = *seen.features;
  for (int i = shuffled.size() - 1; i > 0; --i) {
    std::swap(shuffled.pixels[i], shuffled.pixels[rng_.Below(static_cast<uint32_t>(i + 1))]);
  }
  shuffled.grid = FeatureGrid(shuffled.pixels, sensor_.bounds);
  Frame frame = seen;
  frame.features = std::make_shared<const FrameFeatures>(std::move(shuffled));
  Relocalizer relocalizer = Make();
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(relocalizer.Relocalize(&frame));
}

TEST_P(RelocalizerTest, EmptyMapsAndEmptyFramesAreRefused) {
  Frame empty;
  empty.features = std::make_shared<const FrameFeatures>();
  EXPECT_FALSE(Make().Relocalize(&empty));
  const Map nothing{MapData(sensor_.pyramid)};
  const PlaceIndex no_places(TrainOn(landmarks_));
  Relocalizer relocalizer(nothing, GetParam() ? &no_places : nullptr, sensor_, RelocalizerOptions());
  Frame frame = See(Turned(0));
  EXPECT_FALSE(relocalizer.Relocalize(&frame));
}

TEST_P(RelocalizerTest, CulledKeyFramesAreNoHarm) {
  for (uint32_t i = 3; i < 6; ++i) ASSERT_TRUE(map_.Write()->EraseKeyFrame(KeyFrameId(i)));
  Relocalizer relocalizer = Make();
  Frame frame = See(Turned(-0.15));
  EXPECT_TRUE(relocalizer.Relocalize(&frame) || relocalizer.Relocalize(&frame));
}

INSTANTIATE_TEST_SUITE_P(Vocabulary, RelocalizerTest, testing::Bool());

}  // namespace
}  // namespace orbslam::test
