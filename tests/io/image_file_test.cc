// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/image_file.h"

#include <gmock/gmock.h>
#include <spng.h>
#include <turbojpeg.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "orbslam/util/file.h"
#include "orbslam/util/random.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int kWidth = 37, kHeight = 23;

cv::Mat RandomImage(int type) {
  Rng rng(7);
  cv::Mat image(kHeight, kWidth, type);
  for (size_t i = 0; i < image.total() * image.elemSize(); ++i)
    image.data[i] = static_cast<uchar>(rng.Below(256));
  return image;
}

bool Same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// A PNG of a kind that the project only reads: rows as libspng packs them, and a palette if there is one.
std::string MakePng(spng_color_type color_type, int bits, const cv::Mat& rows, spng_plte* palette = nullptr) {
  spng_ctx* context = spng_ctx_new(SPNG_CTX_ENCODER);
  spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{kWidth, kHeight, static_cast<uint8_t>(bits), static_cast<uint8_t>(color_type), 0, 0, 0};
  spng_set_ihdr(context, &header);
  if (palette != nullptr) spng_set_plte(context, palette);
  const size_t num_bytes = rows.total() * rows.elemSize();
  EXPECT_EQ(spng_encode_image(context, rows.data, num_bytes, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  size_t size = 0;
  int code = 0;
  void* buffer = spng_get_png_buffer(context, &size, &code);
  const std::string bytes(static_cast<const char*>(buffer), size);
  std::free(buffer);
  spng_ctx_free(context);
  return bytes;
}

std::string MakeJpeg(const cv::Mat& image, int subsampling) {
  tjhandle compressor = tjInitCompress();
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  const int format = image.channels() == 1 ? TJPF_GRAY : image.channels() == 3 ? TJPF_BGR : TJPF_CMYK;
  EXPECT_EQ(tjCompress2(compressor, image.data, image.cols, 0, image.rows, format, &buffer, &size,
                        subsampling, 90, 0),
            0);
  const std::string bytes(reinterpret_cast<const char*>(buffer), size);
  tjFree(buffer);
  tjDestroy(compressor);
  return bytes;
}

class ImageFile : public testing::Test {
 protected:
  /// The error of reading these bytes; empty if they were read.
  template <class T>
  std::string ErrorOf(Result<T> (*read)(const std::string&), const std::string& bytes) {
    const Result<T> image = read(dir_.Write("image.xyz", bytes));
    return image.ok() ? "" : image.error().message;
  }
  std::string Bytes(const cv::Mat& image) {
    EXPECT_TRUE(WritePng(dir_.Path("bytes.png"), image).ok());
    const std::string bytes = *ReadFile(dir_.Path("bytes.png"));
    std::filesystem::remove(dir_.Path("bytes.png"));
    return bytes;
  }

  TempDir dir_;
};

TEST_F(ImageFile, WhatIsWrittenIsReadAtEveryCompressionLevelAndChangesNothing) {
  for (const int level : {0, 1, 6, 9}) {
    const cv::Mat bgr = RandomImage(CV_8UC3), gray = RandomImage(CV_8UC1), depth = RandomImage(CV_16UC1);
    ASSERT_TRUE(WritePng(dir_.Path("bgr"), bgr, level).ok());
    ASSERT_TRUE(WritePng(dir_.Path("gray"), gray, level).ok());
    ASSERT_TRUE(WritePng(dir_.Path("depth"), depth, level).ok());
    EXPECT_TRUE(Same(bgr, RandomImage(CV_8UC3)));
    EXPECT_TRUE(Same(*ReadColorOrGray(dir_.Path("bgr")), bgr));
    EXPECT_TRUE(Same(*ReadColorOrGray(dir_.Path("gray")), gray));
    EXPECT_TRUE(Same(*ReadDepth(dir_.Path("depth")), depth));
  }
  const cv::Mat part = RandomImage(CV_16UC1)(cv::Rect(3, 4, 11, 9));
  ASSERT_TRUE(WritePng(dir_.Path("part"), part).ok());
  EXPECT_TRUE(Same(*ReadDepth(dir_.Path("part")), part));
}

TEST_F(ImageFile, GrayOfAPngIsThatOfCvtColor) {
  const cv::Mat bgr = RandomImage(CV_8UC3);
  cv::Mat gray;
  cv::cvtColor(bgr, gray, cv::COLOR_BGR2GRAY);
  ASSERT_TRUE(WritePng(dir_.Path("bgr.png"), bgr).ok());
  EXPECT_TRUE(Same(*ReadGray(dir_.Path("bgr.png")), gray));
}

TEST_F(ImageFile, GrayIsTheSameWithAndWithoutColour) {
  const std::vector<std::string> files = {Bytes(RandomImage(CV_8UC3)), Bytes(RandomImage(CV_8UC1)),
                                          MakeJpeg(RandomImage(CV_8UC3), TJSAMP_420),
                                          MakeJpeg(RandomImage(CV_8UC1), TJSAMP_GRAY)};
  for (const std::string& bytes : files) {
    const std::string path = dir_.Write("image", bytes);
    const Result<GrayAndBgr> both = ReadGrayAndBgr(path);
    ASSERT_TRUE(both.ok());
    EXPECT_TRUE(Same(both->gray, *ReadGray(path)));
    cv::Mat stored = *ReadColorOrGray(path);
    if (stored.channels() == 1) cv::cvtColor(stored, stored, cv::COLOR_GRAY2BGR);
    EXPECT_TRUE(Same(both->bgr, stored));
  }
}

TEST_F(ImageFile, JpegIsCloseToWhatWasCompressed) {
  cv::Mat smooth, gray;
  cv::GaussianBlur(RandomImage(CV_8UC3), smooth, {9, 9}, 3);
  cv::cvtColor(smooth, gray, cv::COLOR_BGR2GRAY);
  const std::string path = dir_.Write("smooth.png", MakeJpeg(smooth, TJSAMP_444));  // not told by its name
  EXPECT_LT(cv::norm(*ReadColorOrGray(path), smooth, cv::NORM_INF), 12);
  EXPECT_LT(cv::norm(*ReadGray(path), gray, cv::NORM_INF), 6);
}

TEST_F(ImageFile, PaletteIsExpandedAndAlphaDropped) {
  spng_plte palette{};
  palette.n_entries = 256;
  for (int i = 0; i < 256; ++i)
    palette.entries[i] = {static_cast<uint8_t>(i), static_cast<uint8_t>(255 - i), 9, 0};
  const cv::Mat indices = RandomImage(CV_8UC1);
  const cv::Mat expanded =
      *ReadColorOrGray(dir_.Write("p", MakePng(SPNG_COLOR_TYPE_INDEXED, 8, indices, &palette)));
  const int index = indices.at<uchar>(5, 6);
  EXPECT_EQ(expanded.at<cv::Vec3b>(5, 6),
            cv::Vec3b(9, static_cast<uchar>(255 - index), static_cast<uchar>(index)));

  const cv::Mat rgba = RandomImage(CV_8UC4), gray_alpha = RandomImage(CV_8UC2);
  cv::Mat bgr, gray;
  cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
  cv::extractChannel(gray_alpha, gray, 0);
  EXPECT_TRUE(
      Same(*ReadColorOrGray(dir_.Write("c", MakePng(SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 8, rgba))), bgr));
  EXPECT_TRUE(
      Same(*ReadColorOrGray(dir_.Write("g", MakePng(SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 8, gray_alpha))), gray));
}

TEST_F(ImageFile, EveryTruncationAndEveryDamagedByteOfAPngIsFound) {
  const std::string color = Bytes(RandomImage(CV_8UC3)), depth = Bytes(RandomImage(CV_16UC1));
  constexpr size_t kChecksumOfTheEndMark = 4;  // behind all data
  for (size_t size = 0; size < depth.size() - kChecksumOfTheEndMark; size += 7) {
    EXPECT_THAT(ErrorOf(ReadDepth, depth.substr(0, size)), HasSubstr("image.xyz: "));
  }
  for (size_t i = 0; i < color.size() - kChecksumOfTheEndMark; i += 5) {
    std::string damaged = color;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_THAT(ErrorOf(ReadGray, damaged), HasSubstr("image.xyz: ")) << "byte " << i;
  }
  EXPECT_THAT(ErrorOf(ReadDepth, depth.substr(0, depth.size() / 2)), HasSubstr("truncated PNG"));
}

TEST_F(ImageFile, EveryTruncationOfAJpegIsFound) {
  const std::string jpeg = MakeJpeg(RandomImage(CV_8UC3), TJSAMP_420);
  for (size_t size = 3; size < jpeg.size(); size += 3) {
    EXPECT_THAT(ErrorOf(ReadGray, jpeg.substr(0, size)), HasSubstr("image.xyz: truncated JPEG")) << size;
    EXPECT_THAT(ErrorOf(ReadColorOrGray, jpeg.substr(0, size)), HasSubstr("image.xyz: truncated JPEG"))
        << size;
  }
}

TEST_F(ImageFile, BytesTooManyInAJpegDoNoHarm) {
  std::string jpeg = MakeJpeg(RandomImage(CV_8UC3), TJSAMP_420);
  const cv::Mat expected = *ReadGray(dir_.Write("clean", jpeg));
  jpeg.insert(jpeg.size() - 2, "\x01\x02\x03");
  EXPECT_TRUE(Same(*ReadGray(dir_.Write("extra", jpeg)), expected));
}

TEST_F(ImageFile, WhatIsNoImageIsNamed) {
  EXPECT_THAT(ErrorOf(ReadGray, ""), HasSubstr("image.xyz: the file is empty"));
  EXPECT_THAT(ErrorOf(ReadDepth, "P5 640 480"), HasSubstr("image.xyz: neither a PNG nor a JPEG"));
  EXPECT_THAT(ReadGray(dir_.Path("none.png")).error().message,
              AllOf(HasSubstr("none.png"), HasSubstr("No such")));
  EXPECT_THAT(ReadGray(dir_.Path("")).error().message, HasSubstr("Is a directory"));
}

TEST_F(ImageFile, WrongKindsAreRefusedWithWhatWasFound) {
  EXPECT_THAT(ErrorOf(ReadGray, Bytes(RandomImage(CV_16UC1))), HasSubstr("found 16 bit, 1 channel"));
  EXPECT_THAT(ErrorOf(ReadDepth, Bytes(RandomImage(CV_8UC1))), HasSubstr("found 8 bit, 1 channel"));
  EXPECT_THAT(ErrorOf(ReadDepth, Bytes(RandomImage(CV_8UC3))), HasSubstr("found 8 bit, 3 channels"));
  EXPECT_THAT(ErrorOf(ReadDepth, MakePng(SPNG_COLOR_TYPE_TRUECOLOR, 16, RandomImage(CV_16UC3))),
              HasSubstr("found 16 bit, 3 channels"));
  EXPECT_THAT(ErrorOf(ReadDepth, MakeJpeg(RandomImage(CV_8UC1), TJSAMP_GRAY)), HasSubstr("found a JPEG"));
  EXPECT_THAT(ErrorOf(ReadGray, MakeJpeg(RandomImage(CV_8UC4), TJSAMP_444)), HasSubstr("found CMYK"));
}

TEST_F(ImageFile, AbsurdSizesAreRefusedBeforeMemoryIsTaken) {
  const std::string wide = Bytes(cv::Mat::zeros(1, 16385, CV_8UC1));
  EXPECT_THAT(ErrorOf(ReadGray, wide), HasSubstr("image.xyz: image of 16385 x 1 px"));
  EXPECT_EQ(ErrorOf(ReadGray, Bytes(cv::Mat::zeros(1, 16384, CV_8UC1))), "");
  EXPECT_THAT(ErrorOf(ReadGray, MakeJpeg(cv::Mat::zeros(16385, 1, CV_8UC1), TJSAMP_GRAY)),
              HasSubstr("1 x 16385 px"));
}

TEST_F(ImageFile, WhatCannotBeWrittenIsAnError) {
  const cv::Mat image = RandomImage(CV_8UC1);
  EXPECT_THAT(WritePng(dir_.Path("none/a.png"), image).error().message,
              HasSubstr("none/a.png: cannot write"));
  EXPECT_THAT(WritePng(dir_.Path(""), image).error().message, HasSubstr("Is a directory"));
  EXPECT_THAT(WritePng("/dev/full", image).error().message, HasSubstr("No space left"));
}

}  // namespace
}  // namespace orbslam
