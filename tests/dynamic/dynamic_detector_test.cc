// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/dynamic_detector.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "rendered_room.h"

namespace orbslam::test {
namespace {

using Movers = std::function<std::vector<RoomBox>(double time_s)>;

struct WatchResult {
  MaskScore mean;  // over the frames counted
  DynamicMask last;
  std::vector<int> ids;  // of the largest object, frame by frame
};

WatchResult Watch(const Movers& movers, uint32_t num_frames, uint32_t first_counted,
                  const DynamicDetectorOptions& options = {}, double sway = 1) {
  const RenderedRoom room;
  DynamicDetector detector(room.camera, DepthModel{}, options);
  WatchResult result;
  for (uint32_t frame = 0; frame < num_frames; ++frame) {
    const std::vector<RoomBox> boxes = movers(frame / 30.0);
    const Rigid3d pose = Sway(frame, sway);
    result.last = detector.Process(room.Render(frame, pose, boxes));
    if (frame < first_counted) continue;
    const MaskScore score = Score(result.last.mask, room.Truth(pose, boxes));
    const double weight = 1.0 / (num_frames - first_counted);
    result.mean.recall += weight * score.recall, result.mean.precision += weight * score.precision;
    result.mean.masked_share += weight * score.masked_share;
    const auto& objects = result.last.objects;
    const auto largest = std::max_element(objects.begin(), objects.end(), [](const auto& a, const auto& b) {
      return a.num_pixels < b.num_pixels;
    });
    if (largest != objects.end()) result.ids.push_back(largest->id);
  }
  return result;
}

std::vector<RoomBox> Nobody(double) { return {}; }
/// Walks to the right at 0.8 m/s, 1.8 m away.
std::vector<RoomBox> AcrossTheAxis(double t) { return {{{-1.1 + 0.8 * t, 0.2, 1.8}, {0.2, 0.8, 0.12}}}; }

TEST(DynamicDetector, MasksNothingWhereNothingMoves) {
  EXPECT_LT(Watch(Nobody, 40, 1).mean.masked_share, 0.001);
  EXPECT_LT(Watch(Nobody, 20, 1, {}, 0).mean.masked_share, 0.001);
}

TEST(DynamicDetector, MasksWhoWalksAcrossTheAxis) {
  const WatchResult result = Watch(AcrossTheAxis, 50, 15);
  EXPECT_GT(result.mean.recall, 0.9);
  EXPECT_GT(result.mean.precision, 0.9);
  ASSERT_FALSE(result.last.objects.empty());
  EXPECT_NEAR(result.last.objects.front().centroid_m.z(), 1.7, 0.15);
  EXPECT_NEAR(result.last.objects.front().velocity_mps.x(), 0.8, 0.15);
  EXPECT_GT(result.last.objects.front().line_integral_ratio, 0);
}

TEST(DynamicDetector, HoldsBackWhatIsNotBelievedAndSaysSo) {
  DynamicDetectorOptions options;
  options.presence = {.min_share = 1, .min_log_odds = 100, .min_age_s = 100};
  const WatchResult result = Watch(AcrossTheAxis, 30, 15, options);
  EXPECT_EQ(result.mean.masked_share, 0);
  EXPECT_FALSE(result.last.objects.empty());
  EXPECT_THAT(result.last.fail_open_reason, testing::HasSubstr("small and new"));
}

TEST(DynamicDetector, MasksWhoWalksAlongTheAxis) {
  const WatchResult result = Watch(
      [](double t) {
        return std::vector<RoomBox>{{{0.2, 0.2, 3.0 - 0.8 * t}, {0.25, 0.7, 0.12}}};
      },
      50, 15);
  EXPECT_GT(result.mean.recall, 0.85);
  EXPECT_GT(result.mean.precision, 0.85);
}

TEST(DynamicDetector, KeepsTheIdOfWhoIsFollowed) {
  const WatchResult result = Watch(AcrossTheAxis, 45, 20);
  ASSERT_GE(result.ids.size(), 20u);
  EXPECT_THAT(result.ids, testing::Each(result.ids.front()));
}

TEST(DynamicDetector, KeepsWhoPausesMasked) {
  const WatchResult result = Watch([](double t) { return AcrossTheAxis(std::min(t, 1.0)); }, 50, 35);
  EXPECT_GT(result.mean.recall, 0.8);
}

TEST(DynamicDetector, KeepsWhoPausesForSecondsMasked) {
  const WatchResult result = Watch([](double t) { return AcrossTheAxis(std::min(t, 1.0)); }, 170, 150);
  EXPECT_GT(result.mean.recall, 0.8);
}

TEST(DynamicDetector, MasksWhoEntersTheView) {
  const WatchResult result = Watch(
      [](double t) {
        return std::vector<RoomBox>{{{-2.2 + t, 0.2, 2.0}, {0.25, 0.8, 0.12}}};
      },
      50, 35);
  EXPECT_GT(result.mean.recall, 0.8);
}

TEST(DynamicDetector, TheSameImagesGiveTheSameMasks) {
  const WatchResult a = Watch(AcrossTheAxis, 15, 1), b = Watch(AcrossTheAxis, 15, 1);
  EXPECT_EQ(cv::norm(a.last.mask, b.last.mask, cv::NORM_L1), 0);
  EXPECT_EQ(a.mean.masked_share, b.mean.masked_share);
}

TEST(DynamicDetector, FailsOpenWithAReasonWhenNothingCanBeSeen) {
  const RenderedRoom room;
  DynamicDetector detector(room.camera, DepthModel{}, {});
  for (uint32_t frame = 0; frame < 25; ++frame) {
    RgbdImage image = room.Render(frame, {}, {});
    image.gray.setTo(90), image.depth_m.setTo(0);
    const DynamicMask mask = detector.Process(image);
    EXPECT_EQ(mask.MaskedShare(), 0);
    EXPECT_FALSE(mask.fail_open_reason.empty());
  }
}

TEST(DynamicDetector, RecoversFromALossOfDepth) {
  const RenderedRoom room;
  DynamicDetector detector(room.camera, DepthModel{}, {});
  DynamicMask mask;
  for (uint32_t frame = 0; frame < 60; ++frame) {
    RgbdImage image = room.Render(frame, Sway(frame), {});
    if (frame >= 15 && frame < 45) image.depth_m.setTo(0);
    mask = detector.Process(image);
    EXPECT_LT(mask.MaskedShare(), 0.01) << frame;
  }
  EXPECT_EQ(mask.fail_open_reason, "");
}

TEST(DynamicDetector, ComparesNothingAcrossAGapInTime) {
  const RenderedRoom room;
  DynamicDetector detector(room.camera, DepthModel{}, {});
  for (uint32_t frame = 0; frame < 20; ++frame)
    detector.Process(room.Render(frame, {}, AcrossTheAxis(frame / 30.0)));
  const Rigid3d elsewhere(So3Exp({0, 0.3, 0}), {0.4, 0, 0.2});
  DynamicMask mask = detector.Process(room.Render(35, elsewhere, {}));
  EXPECT_EQ(mask.MaskedShare(), 0);
  EXPECT_THAT(mask.fail_open_reason, testing::HasSubstr("too old"));
  for (uint32_t frame = 36; frame < 45; ++frame) {
    mask = detector.Process(room.Render(frame, elsewhere, {}));
    EXPECT_EQ(mask.fail_open_reason, "");
    EXPECT_LT(mask.MaskedShare(), 0.01) << frame;
  }
}

TEST(DynamicDetector, FreeSpaceIsWhatFindsMovers) {
  DynamicDetectorOptions without;
  without.fusion.use_free_space = false;
  EXPECT_LT(Watch(AcrossTheAxis, 30, 15, without).mean.recall, Watch(AcrossTheAxis, 30, 15).mean.recall);
}

TEST(DynamicDetector, WorksWithEachSourceOfEvidenceOff) {
  using Switch = std::function<bool&(DynamicDetectorOptions&)>;
  const std::vector<Switch> switches{[](auto& o) -> bool& { return o.fusion.use_carry; },
                                     [](auto& o) -> bool& { return o.fusion.use_klt_residual; },
                                     [](auto& o) -> bool& { return o.fusion.use_attachment; },
                                     [](auto& o) -> bool& { return o.fusion.use_thickness; },
                                     [](auto& o) -> bool& { return o.fusion.use_histogram; },
                                     [](auto& o) -> bool& { return o.sliding.use_sliding; },
                                     [](auto& o) -> bool& { return o.slow_flow.use_slow_flow; },
                                     [](auto& o) -> bool& { return o.camera_motion.far.use_far_motion; },
                                     [](auto& o) -> bool& { return o.whole_things.use_whole_things; },
                                     [](auto& o) -> bool& { return o.growth.use_growth; },
                                     [](auto& o) -> bool& { return o.growth.use_background; },
                                     [](auto& o) -> bool& { return o.growth.use_corners; }};
  for (size_t i = 0; i < switches.size(); ++i) {
    DynamicDetectorOptions options;
    switches[i](options) = false;
    EXPECT_GT(Watch(AcrossTheAxis, 25, 15, options).mean.recall, 0.7) << "switch " << i;
  }
}

}  // namespace
}  // namespace orbslam::test
