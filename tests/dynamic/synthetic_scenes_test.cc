// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "orbslam/dynamic/dynamic_detector.h"
#include "orbslam/synthetic/synthetic_sequence.h"

namespace orbslam {
namespace {

RgbdImage ImageOf(const SyntheticFrame& frame, int id) {
  return {.id = FrameId(static_cast<uint64_t>(id)),
          .timestamp_s = frame.timestamp_s,
          .gray = frame.gray,
          .depth_m = frame.depth_m};
}

struct Masked {
  double recall = 0;   // share of the moving pixels that is masked
  double wrongly = 0;  // share of the pixels of what cannot move that is
};

/// Of a detector with each of the options, over the frames from first_counted to end.
std::vector<Masked> Watch(const SyntheticSequence& sequence, int first, int first_counted, int end,
                          const std::vector<DynamicDetectorOptions>& options) {
  std::vector<DynamicDetector> detectors;
  for (const auto& o : options) detectors.emplace_back(sequence.options().camera, DepthModel{}, o);
  std::vector<Masked> pixels(options.size());
  double moving = 0, fixed = 0;
  for (int i = first; i < end; ++i) {
    const SyntheticFrame frame = sequence.Frame(i);
    const bool counts = i >= first_counted;
    if (counts) moving += cv::countNonZero(frame.mask_moving), fixed += cv::countNonZero(frame.mask == 0);
    for (size_t k = 0; k < detectors.size(); ++k) {
      const cv::Mat mask = detectors[k].Process(ImageOf(frame, i - first)).mask;
      if (!counts || mask.empty()) continue;
      pixels[k].recall += cv::countNonZero(frame.mask_moving & mask);
      pixels[k].wrongly += cv::countNonZero((frame.mask == 0) & mask);
    }
  }
  for (Masked& masked : pixels) masked.recall /= moving, masked.wrongly /= fixed;
  return pixels;
}

/// He comes into view as the camera turns to him: no reference has seen what is behind, and the inside of his
/// shirt is where shirt was two frames ago. Depth alone confirms him as static.
TEST(SlowWalker, IsSeenByHisTextureWhereDepthConfirmsHim) {
  const SyntheticSequence sequence(
      {.seed = 1, .motion = Motion::kHalfsphere, .script = ScriptKind::kWalking});
  DynamicDetectorOptions by_depth_alone;
  by_depth_alone.sliding.use_sliding = false;
  const auto masked = Watch(sequence, 240, 272, 296, {DynamicDetectorOptions(), by_depth_alone});
  EXPECT_GT(masked[0].recall, 0.5);
  EXPECT_GT(masked[0].recall, masked[1].recall + 0.2);
}

/// Two who sit and sway: less from frame to frame than flow can tell, and depth confirms them.
TEST(WhoSits, IsSeenByHisSwayOverHalfASecond) {
  const SyntheticSequence sequence({.seed = 1, .motion = Motion::kStatic, .script = ScriptKind::kSitting});
  DynamicDetectorOptions by_the_last_frame_alone;
  by_the_last_frame_alone.slow_flow.use_slow_flow = false;
  const auto masked = Watch(sequence, 60, 90, 120, {DynamicDetectorOptions(), by_the_last_frame_alone});
  EXPECT_GT(masked[0].recall, 0.5);
  EXPECT_GT(masked[0].recall, masked[1].recall + 0.2);
  EXPECT_LT(masked[0].wrongly, 0.05);  // a rim of some pixels about them is a thirtieth
}

/// A third of them sways by less in half a second than flow can tell.
TEST(WhoSits, IsSeenByHisSwayOverASecond) {
  const SyntheticSequence sequence({.seed = 2, .motion = Motion::kXyz, .script = ScriptKind::kSitting});
  DynamicDetectorOptions over_half_a_second;
  over_half_a_second.slow_flow.long_age_frames = over_half_a_second.slow_flow.age_frames;
  const auto masked = Watch(sequence, 0, 32, 48, {DynamicDetectorOptions(), over_half_a_second});
  EXPECT_GT(masked[0].recall, 0.9);
  EXPECT_GT(masked[0].recall, masked[1].recall + 0.15);
  EXPECT_LT(masked[0].wrongly, 0.05);
}

/// Their hands move, and their backs rest for a while.
TEST(WhoSits, MovesAsAWhole) {
  const SyntheticSequence sequence({.seed = 2, .motion = Motion::kStatic, .script = ScriptKind::kSitting});
  DynamicDetectorOptions part_by_part;
  part_by_part.whole_things.use_whole_things = false;
  const auto masked = Watch(sequence, 0, 12, 36, {DynamicDetectorOptions(), part_by_part});
  EXPECT_GT(masked[0].recall, 0.9);
  EXPECT_GT(masked[0].recall, masked[1].recall + 0.2);
  EXPECT_LT(masked[0].wrongly, 0.04);
}

/// Near things with half of all texture begin to move together: at first so slowly that a camera's motion
/// fits them and the far room at once, if the pictures' sharpness is not used. (In hindsight, and by what is
/// far alone, they are found all the same, but late: both are left out where the fits are compared.)
TEST(SlowStart, OfHalfThePictureIsNotTakenForTheCamera) {
  const SyntheticSequence sequence({.seed = 4, .motion = Motion::kStatic, .script = ScriptKind::kObjects});
  DynamicDetectorOptions tight;
  tight.hindsight.use_hindsight = false;
  tight.camera_motion.far.use_far_motion = false;
  DynamicDetectorOptions tolerant = tight;
  tolerant.camera_motion.min_inlier_px = tolerant.camera_motion.pose.inlier_px;
  const auto masked = Watch(sequence, 0, 40, 60, {DynamicDetectorOptions(), tight, tolerant});
  EXPECT_GT(masked[0].recall, 0.8);
  EXPECT_GT(masked[1].recall, masked[2].recall + 0.2);
}

/// Somebody with a box sets off before a wall while the camera turns: one that goes along with him and turns
/// more would see the same. (He is found as a whole, too, once his hands are; so that is left out.)
TEST(SlowStart, BeforeAWallIsNotTakenForTheCameraThatMovesItself) {
  const SyntheticSequence sequence(
      {.seed = 1, .motion = Motion::kHalfsphere, .script = ScriptKind::kObjects});
  DynamicDetectorOptions with;
  with.whole_things.use_whole_things = false;
  DynamicDetectorOptions without = with;
  without.camera_motion.far.use_far_motion = false;
  const auto masked = Watch(sequence, 0, 22, 32, {with, without});
  EXPECT_GT(masked[0].recall, 0.7);
  EXPECT_GT(masked[0].recall, masked[1].recall + 0.4);
}

/// The camera looks down, and the floor between two people who walk comes into view joined to their feet.
TEST(WalkersOnAFloor, TheFloorIsNotMaskedWithThem) {
  const SyntheticSequence sequence({.seed = 1, .motion = Motion::kRpy, .script = ScriptKind::kWalking});
  DynamicDetectorOptions by_clusters_alone;
  by_clusters_alone.segmentation.use_planes = false;
  const auto masked = Watch(sequence, 190, 270, 290, {DynamicDetectorOptions(), by_clusters_alone});
  EXPECT_LT(masked[0].wrongly, 0.15);  // a rim of some pixels about them is a tenth
  EXPECT_LT(masked[0].wrongly, 0.5 * masked[1].wrongly);
  EXPECT_GT(masked[0].recall, masked[1].recall - 0.02);
}

/// A sixth of a second of a quick walk between the only two frames: no motion to expect, little to compare.
TEST(FirstFrames, AJumpOfTheCameraIsNotTakenForMovers) {
  const SyntheticSequence sequence({.motion = Motion::kLoop,
                                    .camera = SyntheticCamera(320),
                                    .sensor = {.depth_noise = true, .image_noise = true},
                                    .texels_per_metre = 128});
  for (int i = 0; i < 50; i += 5) {
    DynamicDetector detector(sequence.options().camera, DepthModel{}, {});
    detector.Process(ImageOf(sequence.Frame(i), 0));
    EXPECT_LT(detector.Process(ImageOf(sequence.Frame(i + 5), 1)).MaskedShare(), 0.5) << i;
  }
}

}  // namespace
}  // namespace orbslam
