// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/rgbd_images.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <opencv2/core.hpp>

#include "orbslam/io/image_file.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int kWidth = 40, kHeight = 30;

class RgbdImagesTest : public testing::Test {
 protected:
  RgbdImagesTest() {
    camera_.width = kWidth;
    camera_.height = kHeight;
    Write(kWidth, kHeight, kWidth, kHeight);
  }

  void Write(int color_width, int color_height, int depth_width, int depth_height) {
    ASSERT_TRUE(WritePng(entry_.rgb_path, cv::Mat(color_height, color_width, CV_8UC3, {1, 2, 3})).ok());
    ASSERT_TRUE(
        WritePng(entry_.depth_path, cv::Mat(depth_height, depth_width, CV_16UC1, cv::Scalar(5000))).ok());
  }
  std::string LoadError() { return LoadRgbd(entry_, camera_, DepthModel()).error().message; }

  TempDir dir_;
  RgbdEntry entry_{1, "1", dir_.Path("rgb.png"), dir_.Path("depth.png")};
  PinholeCamera camera_;
};

TEST_F(RgbdImagesTest, GivesGrayDepthInMetresAndColourOnlyWhenAsked) {
  const Result<RgbdImages> images = LoadRgbd(entry_, camera_, DepthModel());
  ASSERT_TRUE(images.ok());
  EXPECT_EQ(images->gray.type(), CV_8UC1);
  EXPECT_TRUE(images->bgr.empty());
  EXPECT_EQ(images->depth_m.type(), CV_32FC1);
  EXPECT_EQ(images->depth_m.at<float>(kHeight - 1, kWidth - 1), 1.0f);

  const Result<RgbdImages> colored = LoadRgbd(entry_, camera_, DepthModel(), WithColor::kYes);
  ASSERT_TRUE(colored.ok());
  EXPECT_EQ(colored->bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(cv::norm(colored->gray, images->gray, cv::NORM_INF), 0);
}

TEST_F(RgbdImagesTest, DepthIsUnitsOverFactorAndNothingWhereNothingWasMeasured) {
  cv::Mat raw(256, 256, CV_16UC1);
  for (int value = 0; value < 65536; ++value)
    raw.at<uint16_t>(value / 256, value % 256) = static_cast<uint16_t>(value);
  DepthModel model;
  model.units_per_metre = 5208;
  const cv::Mat depth_m = DepthInMetres(raw, model);
  for (int value = 0; value < 65535; ++value) {
    ASSERT_FLOAT_EQ(depth_m.at<float>(value / 256, value % 256), static_cast<float>(value / 5208.0));
  }
  EXPECT_EQ(depth_m.at<float>(255, 255), 0);
}

TEST_F(RgbdImagesTest, SizesThatDoNotFitAreNamed) {
  Write(32, 24, 32, 24);
  EXPECT_THAT(LoadError(), AllOf(HasSubstr("rgb.png"), HasSubstr("32 x 24"), HasSubstr("40 x 30")));
  Write(kWidth, kHeight, 32, 24);
  EXPECT_THAT(LoadError(), AllOf(HasSubstr("depth.png"), HasSubstr("32 x 24"), HasSubstr("40 x 30")));
}

TEST_F(RgbdImagesTest, FilesThatCannotBeReadAreNamed) {
  std::filesystem::remove(entry_.depth_path);
  EXPECT_THAT(LoadError(), AllOf(HasSubstr("depth.png"), HasSubstr("No such file")));
  std::filesystem::remove(entry_.rgb_path);
  EXPECT_THAT(LoadError(), AllOf(HasSubstr("rgb.png"), HasSubstr("No such file")));
}

TEST_F(RgbdImagesTest, LoadsARealSequence) {
  const char* data = std::getenv("ORBSLAM_DATA");
  if (data == nullptr) GTEST_SKIP() << "set ORBSLAM_DATA to a folder with TUM sequences";
  const std::string folder = std::string(data) + "/fr1_xyz";
  const Result<TumSequence> sequence = ReadTumSequence(folder, folder + "/associations.txt");
  ASSERT_TRUE(sequence.ok()) << sequence.error().message;
  camera_.width = 640;
  camera_.height = 480;
  for (size_t i = 0; i < sequence->entries.size(); i += 50) {
    const Result<RgbdImages> images = LoadRgbd(sequence->entries[i], camera_, DepthModel());
    ASSERT_TRUE(images.ok()) << images.error().message;
    const double measured_part = cv::countNonZero(images->depth_m > 0) / (640.0 * 480.0);
    EXPECT_GT(measured_part, 0.5);
    EXPECT_LT(cv::mean(images->depth_m, images->depth_m > 0)[0], 5);  // a desk
  }
}

}  // namespace
}  // namespace orbslam
