// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/mask_supplier.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

namespace orbslam {
namespace {

constexpr RunMode kSequential{.is_sequential = true}, kDataset{}, kLive{.is_live = true};

class MaskSupplierTest : public testing::Test {
 protected:
  MaskSupplierTest() {
    settings_.camera = {.width = 320, .height = 240, .fx = 260, .fy = 260, .cx = 160, .cy = 120};
  }
  std::shared_ptr<const RgbdImage> Image(uint32_t id) const {
    RgbdImage image;
    image.id = FrameId(id);
    image.timestamp_s = id / settings_.fps;
    image.gray = cv::Mat(240, 320, CV_8UC1);
    cv::RNG(4).fill(image.gray, cv::RNG::UNIFORM, 0, 256);
    image.depth_m = cv::Mat(240, 320, CV_32FC1, cv::Scalar(2));
    return std::make_shared<const RgbdImage>(std::move(image));
  }
  static UserMask LeftHalf() {
    return [](const RgbdImage& image) {
      cv::Mat mask = cv::Mat::zeros(image.gray.size(), CV_8UC1);
      mask.colRange(0, mask.cols / 2) = 1;
      return mask;
    };
  }

  Settings settings_;
};

TEST_F(MaskSupplierTest, WithoutSourceThereIsNone) {
  EXPECT_FALSE(MaskSupplier(settings_, false, kDataset, {}).HasSource());
  settings_.detects_motion = false;
  EXPECT_FALSE(MaskSupplier(settings_, true, kDataset, {}).HasSource());
  EXPECT_TRUE(MaskSupplier(settings_, true, kDataset, LeftHalf()).HasSource());
}

TEST_F(MaskSupplierTest, RecordedSequencesGetTheMaskOfTheirFrame) {
  for (const RunMode mode : {kSequential, kDataset}) {
    MaskSupplier supplier(settings_, true, mode, {});
    for (uint32_t i = 0; i < 12; ++i) {
      supplier.Begin(Image(i));
      const DynamicMask mask = supplier.Take(Rigid3d());
      EXPECT_EQ(mask.frame_id, FrameId(i));
      EXPECT_EQ(mask.fail_open_reason.find("late"), std::string::npos);
      EXPECT_GT(mask.latency_s, 0);
    }
    supplier.Stop();
    EXPECT_EQ(supplier.Timings().at("detect").count, 12);
    EXPECT_FALSE(supplier.failure().has_value());
  }
}

TEST_F(MaskSupplierTest, ALiveFrameIsNotHeldUp) {
  MaskSupplier supplier(settings_, true, kLive, {});
  for (uint32_t i = 0; i < 30; ++i) {
    const auto start = std::chrono::steady_clock::now();
    supplier.Begin(Image(i));
    EXPECT_EQ(supplier.Take(Rigid3d()).frame_id, FrameId(i));
    // A frame's time with a margin for a busy machine; waiting for every mask for ever would not end at all.
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  }
}

TEST_F(MaskSupplierTest, TheUsersMaskIsUnitedWithTheDetectors) {
  settings_.user_mask_margin_px = 0;
  for (const bool use_detector : {false, true}) {
    MaskSupplier supplier(settings_, use_detector, kDataset, LeftHalf());
    supplier.Begin(Image(0));
    const DynamicMask mask = supplier.Take(Rigid3d());
    ASSERT_EQ(mask.mask.size(), cv::Size(320, 240));
    EXPECT_EQ(cv::countNonZero(mask.mask.colRange(0, 160)), 160 * 240);
    EXPECT_EQ(cv::countNonZero(mask.mask.colRange(160, 320)), 0) << "nothing moves";
  }
}

TEST_F(MaskSupplierTest, TheUsersMaskIsWidenedByTheMarginAndStaysAsItIs) {
  const cv::Mat square = cv::Mat::zeros(240, 320, CV_8UC1);
  const cv::Rect place(100, 60, 40, 50);
  square(place) = 1;
  for (const int margin : {0, 1, 8}) {
    settings_.user_mask_margin_px = margin;
    MaskSupplier supplier(settings_, false, kDataset, [&](const RgbdImage&) { return square; });
    supplier.Begin(Image(0));
    const cv::Mat mask = supplier.Take(Rigid3d()).mask;
    const cv::Rect wide(place.x - margin, place.y - margin, place.width + 2 * margin,
                        place.height + 2 * margin);
    EXPECT_EQ(cv::countNonZero(mask), wide.area());
    EXPECT_EQ(cv::countNonZero(mask(wide)), wide.area());
    EXPECT_EQ(cv::countNonZero(square), place.area());
  }
}

TEST_F(MaskSupplierTest, StopsAtAnyTime) {
  for (uint32_t n = 0; n < 20; ++n) {
    MaskSupplier supplier(settings_, true, n % 2 ? kDataset : kLive, {});
    for (uint32_t i = 0; i < n % 4; ++i) {
      supplier.Begin(Image(i));
      if (i % 2 == 0) supplier.Take(Rigid3d());
    }
    if (n % 3 == 0) supplier.Stop();
  }
}

}  // namespace
}  // namespace orbslam
