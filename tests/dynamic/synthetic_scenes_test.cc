// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

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

/// Share of the moving pixels that is masked, over the frames from first_counted to end.
double Recall(const SyntheticSequence& sequence, int first, int first_counted, int end,
              const DynamicDetectorOptions& options) {
  DynamicDetector detector(sequence.options().camera, DepthModel{}, options);
  double moving = 0, found = 0;
  for (int i = first; i < end; ++i) {
    const SyntheticFrame frame = sequence.Frame(i);
    const DynamicMask mask = detector.Process(ImageOf(frame, i - first));
    if (i < first_counted) continue;
    moving += cv::countNonZero(frame.mask_moving);
    if (!mask.mask.empty()) found += cv::countNonZero(frame.mask_moving & mask.mask);
  }
  return found / moving;
}

/// He comes into view as the camera turns to him: no reference has seen what is behind, and the inside of his
/// shirt is where shirt was two frames ago. Depth alone confirms him as static.
TEST(SlowWalker, IsSeenByHisTextureWhereDepthConfirmsHim) {
  const SyntheticSequence sequence(
      {.seed = 1, .motion = Motion::kHalfsphere, .script = ScriptKind::kWalking});
  DynamicDetectorOptions by_depth_alone;
  by_depth_alone.sliding.use_sliding = false;
  const double with = Recall(sequence, 240, 272, 296, {});
  const double without = Recall(sequence, 240, 272, 296, by_depth_alone);
  EXPECT_GT(with, 0.5);
  EXPECT_GT(with, without + 0.2);
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
