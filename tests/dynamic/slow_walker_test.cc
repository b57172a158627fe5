// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "orbslam/dynamic/dynamic_detector.h"
#include "orbslam/synthetic/synthetic_sequence.h"

namespace orbslam {
namespace {

/// Share of the moving pixels that is masked, over the frames from first_counted to end.
double Recall(const SyntheticSequence& sequence, int first, int first_counted, int end,
              const DynamicDetectorOptions& options) {
  DynamicDetector detector(sequence.options().camera, DepthModel{}, options);
  double moving = 0, found = 0;
  for (int i = first; i < end; ++i) {
    const SyntheticFrame frame = sequence.Frame(i);
    RgbdImage image;
    image.id = FrameId(static_cast<uint64_t>(i - first));
    image.timestamp_s = frame.timestamp_s;
    image.gray = frame.gray, image.depth_m = frame.depth_m;
    const DynamicMask mask = detector.Process(image);
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

}  // namespace
}  // namespace orbslam
