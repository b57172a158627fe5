// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/mask_files.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "orbslam/io/image_file.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::HasSubstr;

class MaskFilesTest : public testing::Test {
 protected:
  static RgbdEntry Entry(const std::string& stamp) {
    return {.timestamp_s = std::stod(stamp),
            .timestamp_text = stamp,
            .rgb_path = "/somewhere/rgb/" + stamp + ".jpg"};
  }
  static RgbdImage Image(const std::string& stamp) {
    RgbdImage image;
    image.timestamp_text = stamp;
    image.gray = cv::Mat::zeros(6, 8, CV_8UC1);
    return image;
  }
  static cv::Mat Mask() {
    cv::Mat mask = cv::Mat::zeros(6, 8, CV_8UC1);
    mask(cv::Rect(2, 1, 3, 4)) = 1;
    return mask;
  }
  static bool AreEqual(const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero(a != b) == 0; }

  const TempDir dir_;
  const PinholeCamera camera_{.width = 8, .height = 6, .fx = 10, .fy = 10, .cx = 4, .cy = 3};
  const TumSequence sequence_{.entries = {Entry("1.25"), Entry("1.50"), Entry("1.75")}, .warnings = {}};
};

TEST_F(MaskFilesTest, WhatIsWrittenIsReadBackForItsFrame) {
  {
    MaskWriter writer = *MaskWriter::Open(dir_.Path("made/here"), camera_);
    writer.Write(sequence_.entries[0], Mask());
    writer.Write(sequence_.entries[1], cv::Mat());
    EXPECT_TRUE(writer.status().ok());
  }
  const UserMask masks = *MasksFromFolder(dir_.Path("made/here"), sequence_, camera_);
  const cv::Mat first = masks(Image("1.25"));
  EXPECT_TRUE(AreEqual(first, cv::Mat(Mask() * 255)));
  EXPECT_EQ(cv::countNonZero(masks(Image("1.50"))), 0);
}

TEST_F(MaskFilesTest, AMissingBrokenOrWrongSizedMaskIsEmpty) {
  ASSERT_TRUE(WritePng(dir_.Path("1.25.png"), Mask()).ok());
  ASSERT_TRUE(WritePng(dir_.Path("1.50.png"), cv::Mat::ones(5, 8, CV_8UC1)).ok());
  const UserMask masks = *MasksFromFolder(dir_.Path(""), sequence_, camera_);
  EXPECT_FALSE(masks(Image("1.25")).empty());
  EXPECT_TRUE(masks(Image("1.50")).empty());
  EXPECT_TRUE(masks(Image("1.75")).empty());
  dir_.Write("1.75.png", "no picture");
  EXPECT_TRUE(masks(Image("1.75")).empty());
}

TEST_F(MaskFilesTest, AFolderThatCannotServeIsAnErrorThatNamesIt) {
  const auto missing = MasksFromFolder(dir_.Path("nowhere"), sequence_, camera_);
  ASSERT_FALSE(missing.ok());
  EXPECT_THAT(missing.error().message, HasSubstr("nowhere: not a folder"));
  const auto empty = MasksFromFolder(dir_.Path(""), sequence_, camera_);
  ASSERT_FALSE(empty.ok());
  EXPECT_THAT(empty.error().message, HasSubstr("has no mask for any image of the sequence; expected is"));
  EXPECT_THAT(empty.error().message, HasSubstr("1.25.png"));
}

TEST_F(MaskFilesTest, WritingFailsOnceAndWithoutAFolderIsNoWork) {
  MaskWriter writer = *MaskWriter::Open(dir_.Path("gone"), camera_);
  std::filesystem::remove(dir_.Path("gone"));
  writer.Write(sequence_.entries[0], Mask());
  EXPECT_FALSE(writer.status().ok());
  const std::string first = writer.status().error().message;
  writer.Write(sequence_.entries[1], Mask());
  EXPECT_EQ(writer.status().error().message, first);

  MaskWriter none = *MaskWriter::Open("", camera_);
  none.Write(sequence_.entries[0], Mask());
  EXPECT_TRUE(none.status().ok());
  EXPECT_FALSE(MaskWriter::Open(dir_.Write("file", ""), camera_).ok());
}

}  // namespace
}  // namespace orbslam
